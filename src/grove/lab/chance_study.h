#pragma once

// Equations 3, 4 and 8 of the review against rays: how often one that passes through a box passes through a box inside it, and how many tests a divided space costs.

#include <cstdint>
#include <span>
#include <vector>

#include "grove/accel/bvh2.h"
#include "grove/build/primitive_reference.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// A node and one of its children.
struct ChancePair {
  double expected = 0.0;          ///< the ratio of their areas
  double measured = 0.0;          ///< the share of the rays through the node that pass through the child
  std::uint64_t parent_rays = 0;  ///< rays that pass through the node
};

struct ChanceStudy {
  std::vector<ChancePair> pairs;
  // Pairs are weighted by the rays expected in the child.
  double mean_ratio = 1.0;  ///< of measured / expected
  double departure = 0.0;   ///< root mean square of measured / expected - 1
  double noise = 0.0;       ///< what that would be by chance alone
  double r_squared = 0.0;   ///< of measured against expected
};

/// Sends rays through all boxes of a hierarchy that they meet. With an accelerator over the same primitives they end at what they hit; without, they do
/// not. Pairs whose node fewer than 500 rays meet, or whose areas say nothing (a node without area), are left out. One thread; O(rays * nodes met).
[[nodiscard]] ChanceStudy study_chances(const Bvh2& tree, std::span<const Ray> rays, const Accelerator* accelerator);

/// The bounds of primitives, divided by one plane.
struct PlaneTests {
  double position = 0.0;
  double expected = 0.0;  ///< equation 8, by equations 6 and 7
  double measured =
      0.0;  ///< objects on the sides that an average ray through the bounds passes through, one that is on both counted for each
};

/// For equally spaced planes across one axis. Rays end as in study_chances. O(n log n + rays log rays).
[[nodiscard]] std::vector<PlaneTests> study_expected_tests(const ReferenceList& list, int axis, unsigned plane_count,
                                                           std::span<const Ray> rays, const Accelerator* accelerator);

}  // namespace grove
