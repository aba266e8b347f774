#pragma once

#include <cstdint>

#include "grove/scene/gltf/document.h"
#include "grove/scene/scene.h"

namespace grove {

/// Adds all materials of the file to the scene, with the file's numbers, and the textures that they use.
void read_materials(GltfDocument& document, Scene& scene);

/// The material of primitives that name none (all properties at glTF's defaults), which comes after the file's; added when first asked for.
[[nodiscard]] std::uint32_t default_material(const GltfDocument& document, Scene& scene);

}  // namespace grove
