#include "grove/render/surface/surface_table.h"

#include <algorithm>
#include <cmath>

namespace grove {
namespace {

// Of the largest coordinate at hand. Barycentric interpolation and the test of traversal round to a few units of 2^-24 each; 64 of them
// leave room for slanted rays, whose own rounding counts fully while the surface's normal sees only a part.
constexpr float kRelativeError = 0x1p-18F;

float magnitude(const Vec3& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

// The largest coordinate that multiplying a point of this magnitude by `m` can pass through.
float magnitude_through(const Mat4& m, float point_magnitude) {
  float largest = 0.0F;
  for (int row = 0; row < 3; ++row) {
    const float linear = std::fabs(m[0][row]) + std::fabs(m[1][row]) + std::fabs(m[2][row]);
    largest = std::max(largest, linear * point_magnitude + std::fabs(m[3][row]));
  }
  return largest;
}

// The largest stretch of `m` in the sense of the largest row sum.
float stretch(const Mat4& m) {
  float largest = 0.0F;
  for (int row = 0; row < 3; ++row) largest = std::max(largest, std::fabs(m[0][row]) + std::fabs(m[1][row]) + std::fabs(m[2][row]));
  return largest;
}

Vec3 normalised_or(const Vec3& v, const Vec3& fallback) {
  // Scaled first: squares of the edges of tiny or huge triangles leave the range of a float.
  const float largest = magnitude(v);
  if (!(largest > 0.0F) || !std::isfinite(largest)) return fallback;
  return glm::normalize(v / largest);
}

template <typename T>
T interpolate(const std::vector<T>& values, const Triangle& corner, const Vec2& uv) {
  return values[corner.x] * (1.0F - uv.x - uv.y) + values[corner.y] * uv.x + values[corner.z] * uv.y;
}

// How position changes with the texture coordinates over a triangle; left as they are where those say nothing.
void texture_derivatives(const std::vector<Vec2>& uvs, const Triangle& corner, const Vec3& edge1, const Vec3& edge2, Vec3& dp_du,
                         Vec3& dp_dv) {
  const Vec2 d1 = uvs[corner.y] - uvs[corner.x];
  const Vec2 d2 = uvs[corner.z] - uvs[corner.x];
  const float determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0.0F) return;
  dp_du = (d2.y * edge1 - d1.y * edge2) / determinant;
  dp_dv = (d1.x * edge2 - d2.x * edge1) / determinant;
}

void use_first_uvs(SurfacePoint& point) {
  point.second_uv = point.uv;
  point.second_dp_du = point.dp_du;
  point.second_dp_dv = point.dp_dv;
}

Vec2 sphere_uv(const Vec3& normal) {
  const float azimuth = std::atan2(normal.y, normal.x) / (2.0F * kPi);
  return {azimuth < 0.0F ? azimuth + 1.0F : azimuth, std::acos(std::clamp(normal.z, -1.0F, 1.0F)) / kPi};
}

}  // namespace

SurfaceTable::SurfaceTable(const Scene& scene) {
  std::vector<std::uint32_t> first_part(scene.objects.size());
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const Object& object = scene.objects[o];
    first_part[o] = static_cast<std::uint32_t>(parts_.size());
    for (std::uint32_t p = 0; p < object.parts.size(); ++p) {
      PartView view{&object.parts[p], nullptr, nullptr, 0, 0};
      if (const auto* mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
        view.mesh = mesh->get();
        view.first_primitive = view.mesh->first_triangle(p);
        view.first_vertex = view.mesh->first_vertex(p);
      } else {
        view.spheres = std::get<std::shared_ptr<SphereSet>>(object.geometry).get();
        view.first_primitive = view.spheres->first_sphere(p);
      }
      parts_.push_back(view);
    }
  }
  instances_.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const Transform& transform = instance.object_to_world;
    instances_.push_back(
        {first_part[instance.object], transform.is_identity(), glm::determinant(Mat3(transform.matrix())) < 0.0F, &transform});
  }
}

std::uint32_t SurfaceTable::material_of(const Hit& hit) const {
  return part_of(hit).part->material;
}

SurfacePoint SurfaceTable::at(const Ray& ray, const Hit& hit) const {
  const InstanceView& instance = instances_[hit.instance == kInvalidId ? 0 : hit.instance];
  const PartView& part = parts_[instance.first_part + hit.geometry];
  if (part.mesh != nullptr) return triangle_point(instance, part, hit.primitive, {hit.u, hit.v});
  const SphereSet::Sphere& sphere = part.spheres->sphere(part.first_primitive + hit.primitive);
  // In double: the point is far from the ray's origin compared with the radius, often.
  const glm::dvec3 world = glm::dvec3(ray.origin) + static_cast<double>(hit.t) * glm::dvec3(ray.direction);
  const glm::dvec3 local =
      instance.is_identity ? world : glm::dvec3(glm::dmat4(instance.transform->inverse_matrix()) * glm::dvec4(world, 1.0));
  const auto normal = Vec3(glm::normalize(local - glm::dvec3(sphere.centre)));
  return sphere_point(instance, part, hit.primitive, normal, {hit.u, hit.v});
}

SurfaceCoordinates SurfaceTable::coordinates_at(const Hit& hit) const {
  const PartView& part = part_of(hit);
  const Vec2 barycentric(hit.u, hit.v);
  SurfaceCoordinates coordinates{barycentric, 1.0F};
  const Part& data = *part.part;
  if (part.mesh == nullptr || (data.uvs.empty() && data.second_uvs.empty() && data.colours.empty())) return coordinates;
  const Triangle corner = part.mesh->triangles()[part.first_primitive + hit.primitive] - Triangle(part.first_vertex);
  if (!data.uvs.empty()) coordinates.texture = interpolate(data.uvs, corner, barycentric);
  if (!data.second_uvs.empty()) coordinates.texture.sets[1] = interpolate(data.second_uvs, corner, barycentric);
  if (!data.colours.empty()) coordinates.colour_alpha = interpolate(data.colours, corner, barycentric).w;
  return coordinates;
}

void SurfaceTable::prefetch_primitive(const Hit& hit) const {
  const PartView& part = part_of(hit);
  if (part.mesh != nullptr) __builtin_prefetch(&part.mesh->triangles()[part.first_primitive + hit.primitive]);
}

void SurfaceTable::prefetch_corners(const Hit& hit) const {
  const PartView& part = part_of(hit);
  if (part.mesh == nullptr) return;
  const Triangle triangle = part.mesh->triangles()[part.first_primitive + hit.primitive];
  const Part& data = *part.part;
  for (int corner = 0; corner < 3; ++corner) {
    __builtin_prefetch(&part.mesh->vertices()[triangle[corner]]);
    const std::uint32_t in_part = triangle[corner] - part.first_vertex;
    if (!data.normals.empty()) __builtin_prefetch(&data.normals[in_part]);
    if (!data.uvs.empty()) __builtin_prefetch(&data.uvs[in_part]);
  }
}

SurfacePoint SurfaceTable::on_triangle(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive, const Vec2& uv) const {
  const InstanceView& view = instances_[instance];
  return triangle_point(view, parts_[view.first_part + geometry], primitive, uv);
}

SurfacePoint SurfaceTable::on_sphere(std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive, const Vec3& normal) const {
  const InstanceView& view = instances_[instance];
  return sphere_point(view, parts_[view.first_part + geometry], primitive, normal, sphere_uv(normal));
}

SurfacePoint SurfaceTable::triangle_point(const InstanceView& instance, const PartView& part, std::uint32_t primitive,
                                          const Vec2& barycentric) const {
  const Triangle triangle = part.mesh->triangles()[part.first_primitive + primitive];
  const Vec3& v0 = part.mesh->vertices()[triangle.x];
  const Vec3& v1 = part.mesh->vertices()[triangle.y];
  const Vec3& v2 = part.mesh->vertices()[triangle.z];
  const Triangle corner = triangle - Triangle(part.first_vertex);
  const Part& data = *part.part;

  SurfacePoint point;
  point.material = data.material;
  point.position = (1.0F - barycentric.x - barycentric.y) * v0 + barycentric.x * v1 + barycentric.y * v2;
  const Vec3 edge1 = v1 - v0;
  const Vec3 edge2 = v2 - v0;
  const float scale = std::max(magnitude(edge1), magnitude(edge2));
  const Vec3 cross = scale > 0.0F ? glm::cross(edge1 / scale, edge2 / scale) : Vec3(0.0F);
  point.geometric_normal = normalised_or(cross, Vec3(0.0F, 0.0F, 1.0F));
  if (data.normals.empty()) {
    if (data.flip_orientation) point.geometric_normal = -point.geometric_normal;
    point.shading_normal = point.geometric_normal;
  } else {
    // The side is one for the whole triangle, so that what it emits does too.
    const Vec3 sum = data.normals[corner.x] + data.normals[corner.y] + data.normals[corner.z];
    if (glm::dot(sum, point.geometric_normal) < 0.0F) point.geometric_normal = -point.geometric_normal;
    point.shading_normal = normalised_or(interpolate(data.normals, corner, barycentric), point.geometric_normal);
  }
  if (!data.colours.empty()) point.colour = interpolate(data.colours, corner, barycentric);
  if (!data.tangents.empty()) {
    point.tangent = Vec4(Vec3(interpolate(data.tangents, corner, barycentric)), data.tangents[corner.x].w);
  }
  if (data.uvs.empty()) {
    point.uv = barycentric;
    point.dp_du = edge1;
    point.dp_dv = edge2;
  } else {
    point.uv = interpolate(data.uvs, corner, barycentric);
    texture_derivatives(data.uvs, corner, edge1, edge2, point.dp_du, point.dp_dv);
  }
  if (data.second_uvs.empty()) {
    use_first_uvs(point);
  } else {
    point.second_uv = interpolate(data.second_uvs, corner, barycentric);
    texture_derivatives(data.second_uvs, corner, edge1, edge2, point.second_dp_du, point.second_dp_dv);
  }
  to_world(instance, std::max({magnitude(v0), magnitude(v1), magnitude(v2)}), point);
  return point;
}

SurfacePoint SurfaceTable::sphere_point(const InstanceView& instance, const PartView& part, std::uint32_t primitive, const Vec3& normal,
                                        const Vec2& uv) const {
  const SphereSet::Sphere& sphere = part.spheres->sphere(part.first_primitive + primitive);
  SurfacePoint point;
  point.material = part.part->material;
  point.position = sphere.centre + sphere.radius * normal;
  point.geometric_normal = part.part->flip_orientation ? -normal : normal;
  point.shading_normal = point.geometric_normal;
  point.uv = uv;
  // With u = azimuth / 2 pi and v = polar angle / pi.
  const float sine = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  point.dp_du = 2.0F * kPi * sphere.radius * Vec3(-normal.y, normal.x, 0.0F);
  if (sine > 0.0F) point.dp_dv = kPi * sphere.radius * Vec3(normal.z * normal.x / sine, normal.z * normal.y / sine, -sine);
  use_first_uvs(point);
  to_world(instance, magnitude(sphere.centre) + sphere.radius, point);
  return point;
}

void SurfaceTable::to_world(const InstanceView& instance, float object_magnitude, SurfacePoint& point) {
  if (instance.is_identity) {
    point.error = kRelativeError * object_magnitude;
    return;
  }
  const Transform& transform = *instance.transform;
  point.position = transform.point(point.position);
  // Rounding happens on the way out (in world units) and, when a ray comes back in, in object units, which the transform stretches.
  const float outward = magnitude_through(transform.matrix(), object_magnitude);
  const float inward = magnitude_through(transform.inverse_matrix(), magnitude(point.position)) * stretch(transform.matrix());
  point.error = kRelativeError * std::max(outward, inward);
  point.geometric_normal = normalised_or(transform.normal(point.geometric_normal), Vec3(0.0F, 0.0F, 1.0F));
  point.shading_normal = normalised_or(transform.normal(point.shading_normal), point.geometric_normal);
  point.dp_du = transform.vector(point.dp_du);
  point.dp_dv = transform.vector(point.dp_dv);
  point.second_dp_du = transform.vector(point.second_dp_du);
  point.second_dp_dv = transform.vector(point.second_dp_dv);
  const float handedness = instance.is_mirrored ? -point.tangent.w : point.tangent.w;
  point.tangent = Vec4(transform.vector(Vec3(point.tangent)), handedness);
}

}  // namespace grove
