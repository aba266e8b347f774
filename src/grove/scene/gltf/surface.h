#pragma once

#include <span>
#include <string>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/gltf/skin.h"
#include "grove/scene/scene.h"

namespace grove {

/// The triangles of one glTF primitive with their attributes; these are empty or complete, as in Part.
struct GltfSurface {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec2> second_uvs;
  std::vector<Vec4> tangents;
  std::vector<Vec4> colours;
};

/// Reads a primitive with its morph targets blended by `morph_weights` (one each, or fewer: the rest is 0), and bent by `skin` when
/// there is one. No triangles when the primitive has none. Warns about what is left out.
[[nodiscard]] GltfSurface read_surface(GltfDocument& document, Scene& scene, const JsonCursor& primitive,
                                       std::span<const double> morph_weights, const GltfSkin* skin);

/// Takes a surface to another space. A reflection turns the winding over, so that the front stays the front.
void transform_surface(GltfSurface& surface, const Mat4& matrix);

}  // namespace grove
