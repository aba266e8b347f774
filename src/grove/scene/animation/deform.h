#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "grove/math/vector.h"

namespace grove {

/// How far a morph target of weight 1 moves each vertex; each array is empty or complete.
struct MorphTarget {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec3> tangents;
};

/// Four joints that hold each vertex, and how much. Weights are 0 or more, and over all sets of a vertex they sum to 1.
struct SkinSet {
  std::vector<glm::u32vec4> joints;
  std::vector<Vec4> weights;
};

/// A surface before it is morphed and bent.
struct DeformableSurface {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;   ///< or empty
  std::vector<Vec4> tangents;  ///< or empty
  std::vector<Triangle> triangles;
  std::vector<MorphTarget> targets;
  std::vector<SkinSet> skin;  ///< any number of sets
};

/// Where the deformed vertices go: room for one each; normals and tangents where the surface has them. They may be the surface's own.
struct DeformedVertices {
  std::span<Vec3> positions;
  std::span<Vec3> normals;
  std::span<Vec4> tangents;
};

/// Adds the morph targets times their weights (one a target, or fewer: the rest is 0; glTF 2.0 section 3.7.2.2), then bends the surface by its joints
/// (linear blend skinning, section 3.7.3.3) unless `joints` is empty. `joints` takes the bind pose to world space for each joint; every joint that the skin
/// names must be there. Normals and tangents come out of unit length; a normal that has no direction takes that of a triangle beside it. Parallel in the
/// caller's oneTBB arena, O(vertices (targets of weight other than 0 + sets)).
void deform(const DeformableSurface& surface, std::span<const float> weights, std::span<const Mat4> joints,
            const DeformedVertices& deformed);

/// A vector of the same direction and unit length; zero when there is no direction to keep.
[[nodiscard]] Vec3 safe_normalise(const Vec3& v);

}  // namespace grove
