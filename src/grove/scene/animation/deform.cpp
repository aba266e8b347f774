#include "grove/scene/animation/deform.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "grove/base/parallel.h"
#include "grove/scene/animation/affine.h"

namespace grove {
namespace {

constexpr std::size_t kGrain = 1024;

struct ActiveTarget {
  const MorphTarget* target;
  float weight;
};

void morph(std::size_t v, std::span<const ActiveTarget> active, const DeformedVertices& deformed) {
  for (const auto& [target, weight] : active) {
    if (!target->positions.empty()) deformed.positions[v] += weight * target->positions[v];
    if (!deformed.normals.empty() && !target->normals.empty()) deformed.normals[v] += weight * target->normals[v];
    if (!deformed.tangents.empty() && !target->tangents.empty()) deformed.tangents[v] += Vec4(weight * target->tangents[v], 0.0F);
  }
}

Mat4 blended_joints(std::size_t v, const std::vector<SkinSet>& sets, std::span<const Mat4> joints) {
  Mat4 blend(0.0F);
  for (const SkinSet& set : sets) {
    for (int k = 0; k < 4; ++k) {
      if (set.weights[v][k] > 0.0F) blend += set.weights[v][k] * joints[set.joints[v][k]];
    }
  }
  return blend;
}

void bend(std::size_t v, const Mat4& to_world, const DeformedVertices& deformed) {
  deformed.positions[v] = Vec3(to_world * Vec4(deformed.positions[v], 1.0F));
  if (!deformed.normals.empty()) deformed.normals[v] = normal_matrix(to_world) * deformed.normals[v];
  if (!deformed.tangents.empty()) {
    deformed.tangents[v] = Vec4(Vec3(to_world * Vec4(Vec3(deformed.tangents[v]), 0.0F)), deformed.tangents[v].w);
  }
}

void mend_normals(std::span<const Triangle> triangles, const DeformedVertices& deformed) {
  for (const Triangle& triangle : triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      Vec3& normal = deformed.normals[triangle[corner]];
      if (normal != Vec3(0.0F)) continue;
      const Vec3& a = deformed.positions[triangle.x];
      normal = safe_normalise(glm::cross(deformed.positions[triangle.y] - a, deformed.positions[triangle.z] - a));
    }
  }
}

}  // namespace

Vec3 safe_normalise(const Vec3& v) {
  // Scaled first, so that squares neither overflow nor vanish.
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool is_finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!is_finite || !(largest > 0.0F)) return Vec3(0.0F);
  return glm::normalize(v / largest);
}

void deform(const DeformableSurface& surface, std::span<const float> weights, std::span<const Mat4> joints,
            const DeformedVertices& deformed) {
  std::vector<ActiveTarget> active;
  active.reserve(surface.targets.size());
  for (std::size_t i = 0; i < std::min(surface.targets.size(), weights.size()); ++i) {
    if (weights[i] != 0.0F) active.push_back({&surface.targets[i], weights[i]});
  }
  const bool is_bent = !joints.empty() && !surface.skin.empty();
  std::atomic<bool> lacks_normals = false;
  parallel_for(surface.vertices.size(), kGrain, [&](std::size_t v) {
    deformed.positions[v] = surface.vertices[v];
    if (!deformed.normals.empty()) deformed.normals[v] = surface.normals[v];
    if (!deformed.tangents.empty()) deformed.tangents[v] = surface.tangents[v];
    morph(v, active, deformed);
    if (is_bent) bend(v, blended_joints(v, surface.skin, joints), deformed);
    if (!deformed.normals.empty()) {
      deformed.normals[v] = safe_normalise(deformed.normals[v]);
      if (deformed.normals[v] == Vec3(0.0F)) lacks_normals.store(true, std::memory_order_relaxed);
    }
    if (!deformed.tangents.empty()) {
      Vec4& tangent = deformed.tangents[v];
      tangent = Vec4(safe_normalise(Vec3(tangent)), tangent.w < 0.0F ? -1.0F : 1.0F);
    }
  });
  if (lacks_normals) mend_normals(surface.triangles, deformed);
}

}  // namespace grove
