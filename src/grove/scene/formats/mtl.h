#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "grove/scene/scene.h"

namespace grove {

/// Reads a Wavefront material library (by tinyobjloader) and appends its materials, textures and images to `scene`; `ids` gains the number
/// of each material by name (the first of a name counts). A texture that cannot be read is left out with a warning.
///
/// The mapping: Kd, map_Kd -> base colour; Ke, map_Ke -> emission; d, Tr, map_d -> alpha. With Pr or Pm (or their maps): glTF's metal and
/// roughness. Otherwise Ks = 0 is Lambert, and Ks > 0 is plastic whose GGX width comes from the Phong exponent Ns as
/// alpha = sqrt(2 / (Ns + 2)) (Walter, Marschner, Li, Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces",
/// section 5.2), perceptual roughness sqrt(alpha). illum 3, 5 and 8 with Ks above Kd are metal of colour Ks. illum 4, 6, 7 and 9 with d < 1
/// or Tf > 0 are glass of index Ni (1.5 where Ni is 1 or less), coloured by Tf.
/// Throws InputError when the file cannot be read.
void load_mtl(const std::filesystem::path& file, Scene& scene, std::map<std::string, std::uint32_t>& ids);

}  // namespace grove
