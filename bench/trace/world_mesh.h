#pragma once

#include <memory>

#include "grove/geometry/triangle_mesh.h"
#include "grove/scene/scene.h"

namespace grove::bench {

/// All triangles of a scene in world space, instances multiplied out, as one part: the same input for every contender.
/// Spheres are left out. Throws InputError when there are no triangles.
[[nodiscard]] std::shared_ptr<const TriangleMesh> world_mesh(const Scene& scene);

/// A scene of one mesh, so that the lab can make rays for it; cameras are taken from `scene`.
[[nodiscard]] Scene scene_of(const Scene& scene, const std::shared_ptr<const TriangleMesh>& mesh);

}  // namespace grove::bench
