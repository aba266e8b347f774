#include "grove/scene/pbrt/shapes.h"

namespace grove::pbrt {
namespace {

std::optional<ShapeMesh> make_mesh(const ShapeDirective& shape, Context& context) {
  const ParameterList& parameters = shape.parameters;
  if (shape.type == "trianglemesh") return make_triangle_mesh(parameters);
  if (shape.type == "plymesh") return make_ply_mesh(parameters, context);
  if (shape.type == "bilinearmesh") return make_bilinear_mesh(parameters, context);
  if (shape.type == "loopsubdiv") return make_control_mesh(parameters, context);
  if (shape.type == "sphere") return make_sphere(parameters, context);
  if (shape.type == "disk") return make_disk(parameters, context);
  if (shape.type == "cylinder") return make_cylinder(parameters, context);
  if (shape.type == "curve") return make_curve(parameters, context);
  return std::nullopt;
}

}  // namespace

ShapeGeometry build_shape(const ShapeDirective& shape, const Matrix& to_target, bool textured, Context& context) {
  const Place& place = shape.parameters.place();
  if (!is_usable(to_target)) {
    context.warnings.add(place, "a shape under a transform that is singular, projective or not finite is left out");
    return {};
  }
  if (shape.type == "sphere" && !textured) {
    if (const auto sphere = analytic_sphere(shape.parameters, to_target)) return {.mesh = {}, .sphere = sphere};
  }
  std::optional<ShapeMesh> mesh = make_mesh(shape, context);
  if (!mesh) {
    context.warnings.add(place, "the shape \"" + shape.type +
                                    "\" is not supported and left out; supported are trianglemesh plymesh bilinearmesh loopsubdiv "
                                    "sphere disk cylinder curve");
    return {};
  }
  place_mesh(*mesh, to_target, shape.reverse_orientation);
  if (textured) add_default_uvs(*mesh);
  return {.mesh = std::move(*mesh), .sphere = std::nullopt};
}

}  // namespace grove::pbrt
