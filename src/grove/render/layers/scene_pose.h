#pragma once

#include <variant>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/sphere_set.h"
#include "grove/math/transform.h"
#include "grove/scene/scene.h"

namespace grove {

/// Where everything of a scene was at one time, to measure motion against once the scene has moved on. Holds copies, so that the scene may change
/// in place. Memory: 12 bytes a vertex, 16 a sphere, 132 an instance. Any number of threads may read one.
class ScenePose {
 public:
  explicit ScenePose(const Scene& scene);

  /// Where the surface was that `hit` found at `position` in `now`, the same scene at another time. What has no counterpart here (an instance that is new,
  /// a mesh of another number of vertices) has not moved. O(1).
  [[nodiscard]] Vec3 position_then(const Scene& now, const Hit& hit, const Vec3& position) const;

  /// Whether nothing of `now`, punctual lights included, is elsewhere than here. Compares all vertices.
  [[nodiscard]] bool is_pose_of(const Scene& now) const;

 private:
  using Shape = std::variant<std::vector<Vec3>, std::vector<SphereSet::Sphere>>;

  struct PlacedObject {
    std::uint32_t object;
    Transform object_to_world;
  };

  std::vector<Shape> shapes_;  // of the objects
  std::vector<PlacedObject> instances_;
  std::vector<PunctualLight> lights_;
};

}  // namespace grove
