#pragma once

#include "grove/math/box.h"

namespace grove {

/// Whether a triangle and a closed box share a point, by the 13 axes on which they can be apart (Akenine-Möller 2001, "Fast 3D Triangle-Box Overlap
/// Testing"), in double. Where rounding leaves it open the answer is yes, which is no farther than 1e-15 of the largest distance from the box's centre.
[[nodiscard]] bool overlaps_box(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Box& box);

}  // namespace grove
