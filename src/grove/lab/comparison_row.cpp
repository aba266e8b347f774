#include "grove/lab/comparison_row.h"

#include <memory>

#include "grove/lab/largest_object.h"

namespace grove {

void describe_structure(const SceneAccelerator& accelerator, ComparisonRow& row) {
  const StructureStatistics& statistics = accelerator.statistics();
  const StructureQuality quality = accelerator.measure_quality();
  row.bytes = statistics.bytes;
  row.expected_cost = statistics.expected_cost;
  row.references = statistics.references;
  row.nodes = statistics.nodes;
  row.leaves = statistics.leaves;
  row.depth = statistics.depth;
  if (quality.end_point_overlap) row.end_point_overlap = quality.end_point_overlap->value;
  row.sibling_overlap = quality.sibling_overlap;
  row.duplication = quality.duplication;
  // With a top level, references to instances are among them.
  if (!row.duplication && statistics.primitives > 0 && !accelerator.has_top_level())
    row.duplication = static_cast<double>(statistics.references) / static_cast<double>(statistics.primitives);
  row.is_described = true;
}

std::optional<UpdateTrial> try_update(const Scene& scene, const std::string& spec) {
  const Object* const object = largest_object(scene);
  // Hierarchies have a refit; `fast` over triangles has none.
  const bool has_refit = spec.starts_with("bvh") || (spec.starts_with("fast") && object != nullptr && object->geometry.index() != 0);
  if (object == nullptr || !has_refit) return std::nullopt;
  const std::unique_ptr<Accelerator> structure = build(geometry_of(*object), spec);
  UpdateSettings settings;
  settings.policy = UpdatePolicy::refit;
  const UpdateReport report = structure->update(settings);
  return UpdateTrial{report.method, report.seconds};
}

}  // namespace grove
