#pragma once

#include <cstddef>
#include <cstdint>

#include "grove/traverse/simd/batch_ray.h"

namespace grove {

/// Up to kMost rays as rows of numbers, which BatchRay names. Set up by simd/ray_setup-inl.h.
template <std::size_t kMost>
struct RayRows {
  alignas(64) float inverse[4][kMost];  ///< of x, y and z; t_min
  float near_offset[4][kMost];          ///< and the depth's pad
  float far_offset[4][kMost];           ///< and inverse_z
  float minus_origin_k[4][kMost];       ///< and shear_x
  float direction_k[4][kMost];          ///< and shear_y
  std::uint32_t octant[kMost];          ///< by the signs of the direction, as nodes number their orders
  std::uint32_t axes[kMost];            ///< that triangles are tested along, as kRayAxes has them
};

}  // namespace grove
