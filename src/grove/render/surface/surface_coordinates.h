#pragma once

#include "grove/render/texture/texture_coordinates.h"

namespace grove {

/// What decides how much light passes a surface at a place: far less than a SurfacePoint, since it is asked about more hits than are shaded.
struct SurfaceCoordinates {
  TextureCoordinates texture;
  float colour_alpha = 1.0F;  ///< of the vertex colour
};

}  // namespace grove
