#pragma once

#include <optional>

#include "grove/geometry/sphere_set.h"
#include "grove/scene/pbrt/context.h"
#include "grove/scene/pbrt/description.h"
#include "grove/scene/pbrt/shape_mesh.h"

namespace grove::pbrt {

/// What became of a Shape directive: a sphere where there is one, else triangles (none where the shape cannot be used; a warning says why).
struct ShapeGeometry {
  ShapeMesh mesh;
  std::optional<SphereSet::Sphere> sphere;
};

/// Builds a shape in the space that `to_target` leads to. `textured` says that texture coordinates will be looked at: then spheres become
/// triangles, because an analytic one has no coordinates of its own, and meshes without get pbrt's. Throws InputError for wrong parameters.
[[nodiscard]] ShapeGeometry build_shape(const ShapeDirective& shape, const Matrix& to_target, bool textured, Context& context);

// One maker per shape, in the space of the shape.
[[nodiscard]] ShapeMesh make_triangle_mesh(const ParameterList& parameters);
[[nodiscard]] ShapeMesh make_ply_mesh(const ParameterList& parameters, Context& context);
[[nodiscard]] ShapeMesh make_control_mesh(const ParameterList& parameters, Context& context);
[[nodiscard]] ShapeMesh make_bilinear_mesh(const ParameterList& parameters, Context& context);
[[nodiscard]] ShapeMesh make_sphere(const ParameterList& parameters, const Context& context);
[[nodiscard]] ShapeMesh make_disk(const ParameterList& parameters, const Context& context);
[[nodiscard]] ShapeMesh make_cylinder(const ParameterList& parameters, const Context& context);
/// The sphere itself when it is a whole one and `to_target` keeps it round.
[[nodiscard]] std::optional<SphereSet::Sphere> analytic_sphere(const ParameterList& parameters, const Matrix& to_target);
[[nodiscard]] ShapeMesh make_curve(const ParameterList& parameters, Context& context);

}  // namespace grove::pbrt
