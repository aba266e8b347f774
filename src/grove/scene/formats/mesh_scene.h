#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// Keeps out triangles that can never be hit (a corner that is not finite, or beyond 1e38); the rest stay in order. Returns how many went.
std::size_t drop_unhittable(const std::vector<Vec3>& vertices, std::vector<Triangle>& triangles);

/// The warning for `count` such triangles; call it with count > 0.
[[nodiscard]] std::string unhittable_warning(std::size_t count);

/// Makes normals unit length; those that are zero or not finite are replaced by the area-weighted mean of the triangles' normals there.
void mend_normals(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles, std::vector<Vec3>& normals);

/// The material of files that have none: light grey, rather rough plastic.
[[nodiscard]] Material default_material();

/// A scene of one mesh with one part and one material.
[[nodiscard]] Scene single_mesh_scene(TriangleMesh mesh, Part part, Material material);

}  // namespace grove
