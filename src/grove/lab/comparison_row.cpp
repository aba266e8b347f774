#include "grove/lab/comparison_row.h"

namespace grove {

void describe_structure(const StructureStatistics& statistics, const StructureQuality& quality, ComparisonRow& row) {
  row.bytes = statistics.bytes;
  row.expected_cost = statistics.expected_cost;
  row.references = statistics.references;
  row.nodes = statistics.nodes;
  row.leaves = statistics.leaves;
  row.depth = statistics.depth;
  if (quality.end_point_overlap) row.end_point_overlap = quality.end_point_overlap->value;
  row.sibling_overlap = quality.sibling_overlap;
}

}  // namespace grove
