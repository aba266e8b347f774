#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "grove/math/vector.h"
#include "grove/scene/animation/deform.h"
#include "grove/scene/gltf/document.h"
#include "grove/scene/scene.h"

namespace grove {

/// The triangles of one glTF primitive with their attributes; these are empty or complete, as in Part.
struct GltfSurface {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec4> tangents;
  std::vector<Vec4> colours;
  /// What it was before it was morphed and bent, with all its targets, where that was asked for.
  std::optional<DeformableSurface> undeformed;
};

/// How a primitive is to be shaped.
struct GltfShape {
  std::span<const float> morph_weights;  ///< one a target, or fewer: the rest is 0
  std::span<const Mat4> joints;          ///< from the bind pose to the world; none where there is no skin
  bool keeps_undeformed = false;
};

/// Reads a primitive, morphs it and bends it by its joints (animation/deform.h). No triangles when the primitive has none. Warns about what is left out.
[[nodiscard]] GltfSurface read_surface(GltfDocument& document, Scene& scene, const JsonCursor& primitive, const GltfShape& shape);

/// Takes a surface to another space. A reflection turns the winding over, so that the front stays the front.
void transform_surface(GltfSurface& surface, const Mat4& matrix);

}  // namespace grove
