#pragma once

#include <cstdint>
#include <optional>

namespace grove {

/// A figure estimated from random samples.
struct SampledFigure {
  double value = 0.0;
  double error = 0.0;  ///< standard error
  std::uint64_t sample_count = 0;
};

/// What there is to say of a hierarchy beyond its expected cost. A figure that cannot be measured is missing.
struct StructureQuality {
  /// See end_point_overlap.h. Only where the surfaces of the geometry can be sampled.
  std::optional<SampledFigure> end_point_overlap;
  /// See sibling_overlap.h.
  std::optional<double> sibling_overlap;
  /// References over primitives that are referenced: 1 where no split has divided a primitive.
  std::optional<double> duplication;
};

}  // namespace grove
