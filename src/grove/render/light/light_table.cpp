#include "grove/render/light/light_table.h"

#include <algorithm>
#include <cmath>

#include "grove/render/bsdf/bsdf_types.h"
#include "grove/render/light/punctual.h"
#include "grove/render/material/gltf_surface.h"
#include "grove/render/material/opacity.h"
#include "grove/render/sampling/warp.h"
#include "grove/render/surface/frame.h"
#include "grove/render/texture/evaluate_texture.h"

namespace grove {
namespace {

// World area of a triangle, in double for tiny and huge ones.
float triangle_area(const TriangleMesh& mesh, std::uint32_t id, const Transform& transform) {
  const Triangle& triangle = mesh.triangles()[id];
  const glm::dmat4 matrix(transform.matrix());
  glm::dvec3 corner[3];
  for (int i = 0; i < 3; ++i) corner[i] = glm::dvec3(matrix * glm::dvec4(glm::dvec3(mesh.vertices()[triangle[i]]), 1.0));
  return static_cast<float>(0.5 * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])));
}

// The scale of a transform that keeps angles; 0 of one that does not.
float similarity_scale(const Transform& transform) {
  const Mat3 m(transform.matrix());
  const float scale = glm::length(m[0]);
  const float tolerance = 1e-4F * scale * scale;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const float expected = a == b ? scale * scale : 0.0F;
      if (!(std::fabs(glm::dot(m[a], m[b]) - expected) <= tolerance)) return 0.0F;
    }
  }
  return scale;
}

// Whether all corners lie in one plane with the middle of the group's box.
bool is_flat(const LightChoice::Group& group, const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end,
             const Transform& transform) {
  const Vec3 middle = group.box.centre();
  const float tolerance = 1e-3F * glm::length(group.box.extent());
  for (std::uint32_t t = first; t < end; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 offset = transform.point(mesh.vertices()[mesh.triangles()[t][corner]]) - middle;
      if (!(std::fabs(glm::dot(offset, group.normal)) <= tolerance)) return false;
    }
  }
  return true;
}

// A light without area. Beyond the inner cone a spot's light ends at the outer one.
LightDescription describe(const PunctualLight& light, float strength) {
  LightDescription result;
  result.bounds.intensity = strength;
  if (light.kind == PunctualLightKind::directional) {
    result.direction = -light.direction;
    return result;
  }
  result.bounds.box.grow(light.position);
  result.bounds.axis = light.direction;
  const bool is_spot = light.kind == PunctualLightKind::spot;
  result.bounds.theta_o = is_spot ? light.inner_angle : kPi;
  result.bounds.theta_e = is_spot ? light.outer_angle - light.inner_angle : 0.5F * kPi;
  return result;
}

}  // namespace

LightTable::LightTable(const Scene& scene, const SurfaceTable& surfaces, LightSampling sampling)
    : scene_(&scene), surfaces_(&surfaces), sampling_(sampling) {
  if (scene.environment.is_on()) {
    const std::uint32_t image = scene.environment.image;
    environment_ = EnvironmentLight(scene.environment, image == 0xffffffffU ? nullptr : scene.images[image]);
  }
  gather();
}

void LightTable::gather() {
  lights_.clear();
  first_part_.clear();
  first_light_.clear();
  environment_light_ = kInvalidId;
  Gathered gathered;
  add_surfaces(gathered);
  add_punctual(gathered);
  if (!scene_->environment.is_on() && has_default_sky_ != lights_.empty()) {
    has_default_sky_ = lights_.empty();
    environment_ = has_default_sky_ ? make_default_sky() : EnvironmentLight();
  }
  // Light that comes from everywhere alike is found best by scattering: to choose its direction without a look at the surface adds a ray and noise.
  if (environment_.is_on() && !environment_.is_constant()) {
    environment_light_ = static_cast<std::uint32_t>(lights_.size());
    lights_.push_back({.kind = Kind::environment});
    const float irradiance = kPi * environment_.mean_luminance();
    gathered.descriptions.emplace_back().bounds.intensity = irradiance;
    gathered.groups.push_back({.first = environment_light_, .count = 1, .box = {}, .strength = irradiance});
  }
  const float scene_radius = sampling_ == LightSampling::power ? 0.5F * glm::length(scene_->bounds().extent()) : 0.0F;
  selection_ = LightSelection(sampling_, gathered.descriptions, std::move(gathered.groups), scene_radius);
}

void LightTable::add_punctual(Gathered& gathered) {
  for (std::uint32_t i = 0; i < scene_->lights.size(); ++i) {
    const PunctualLight& light = scene_->lights[i];
    const float strength = luminance(light.intensity);
    if (!(strength > 0.0F) || !std::isfinite(strength)) continue;
    LightChoice::Group group{.first = static_cast<std::uint32_t>(lights_.size()), .count = 1, .box = {}, .strength = strength};
    if (light.kind != PunctualLightKind::directional) group.box.grow(light.position);
    if (light.kind == PunctualLightKind::spot) {
      group.is_planar = true;
      group.normal = light.direction;
    }
    lights_.push_back({.kind = Kind::punctual, .instance = i});
    gathered.descriptions.push_back(describe(light, strength));
    gathered.groups.push_back(group);
  }
}

void LightTable::add_surfaces(Gathered& gathered) {
  for (std::uint32_t i = 0; i < scene_->instances.size(); ++i) {
    const Instance& instance = scene_->instances[i];
    const Object& object = scene_->objects[instance.object];
    first_part_.push_back(static_cast<std::uint32_t>(first_light_.size()));
    for (std::uint32_t p = 0; p < object.parts.size(); ++p) {
      first_light_.push_back(kInvalidId);
      if (!scene_->materials[object.parts[p].material].is_emissive() || !instance.object_to_world.is_invertible()) continue;
      const auto first = static_cast<std::uint32_t>(lights_.size());
      add_part(i, p, gathered);
      if (lights_.size() > first) first_light_.back() = first;
    }
  }
}

void LightTable::add_part(std::uint32_t instance_id, std::uint32_t part, Gathered& gathered) {
  const Instance& instance = scene_->instances[instance_id];
  const Object& object = scene_->objects[instance.object];
  const Material& material = scene_->materials[object.parts[part].material];
  const float radiance = mean_luminance(*scene_, material.emission);
  LightChoice::Group group{.first = static_cast<std::uint32_t>(lights_.size()), .count = 0, .box = {}};
  // `normal`: of a flat light; zeros where light leaves in all directions.
  const auto add = [&](const Light& light, float world_area, const Box& bounds, const Vec3& normal) {
    lights_.push_back(light);
    const float intensity = std::isfinite(radiance * world_area) ? radiance * world_area : 0.0F;
    const bool is_flat = normal != Vec3(0.0F);
    gathered.descriptions.push_back({.bounds = {.box = bounds,
                                                .axis = is_flat ? normal : Vec3(0.0F, 0.0F, 1.0F),
                                                .theta_o = is_flat ? 0.0F : kPi,
                                                .theta_e = 0.5F * kPi,
                                                .intensity = intensity,
                                                .is_two_sided = is_flat && material.two_sided_emission}});
    group.box.grow(bounds);
    group.strength += intensity;
    ++group.count;
  };
  if (const auto* pointer = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
    const TriangleMesh& mesh = **pointer;
    const std::uint32_t first = mesh.first_triangle(part);
    const std::uint32_t end = part + 1 < mesh.part_count() ? mesh.first_triangle(part + 1) : static_cast<std::uint32_t>(mesh.size());
    group.is_planar = !material.two_sided_emission && end > first;
    for (std::uint32_t t = first; t < end; ++t) {
      // What can never be hit must not be sampled either: its area may not even be a number.
      const Box bounds = mesh.bounds(t);
      const float area = bounds.is_empty() ? 0.0F : triangle_area(mesh, t, instance.object_to_world);
      const Vec3 normal =
          area > 0.0F ? surfaces_->on_triangle(instance_id, part, t - first, Vec2(1.0F / 3.0F)).geometric_normal : Vec3(0.0F);
      add({Kind::triangle, instance_id, part, t - first, area}, area, instance.object_to_world.box(bounds), normal);
      if (!group.is_planar || !(area > 0.0F)) continue;
      if (group.normal == Vec3(0.0F)) group.normal = normal;
      group.is_planar = glm::dot(group.normal, normal) > 0.9999F;
    }
    group.is_planar = group.is_planar && is_flat(group, mesh, first, end, instance.object_to_world);
  } else {
    const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(object.geometry);
    const std::uint32_t first = spheres.first_sphere(part);
    const std::uint32_t end = part + 1 < spheres.part_count() ? spheres.first_sphere(part + 1) : static_cast<std::uint32_t>(spheres.size());
    const float area_scale = std::pow(std::fabs(glm::determinant(Mat3(instance.object_to_world.matrix()))), 2.0F / 3.0F);
    for (std::uint32_t s = first; s < end; ++s) {
      const Box bounds = spheres.bounds(s);
      const float radius = bounds.is_empty() ? 0.0F : spheres.sphere(s).radius;
      const float area = 4.0F * kPi * radius * radius;
      // A quarter of the area is seen from any one side.
      add({Kind::sphere, instance_id, part, s - first, area}, 0.25F * area * area_scale, instance.object_to_world.box(bounds), Vec3(0.0F));
    }
  }
  if (group.count > 0) gathered.groups.push_back(group);
}

Vec3 LightTable::emitted(const SurfacePoint& point, const Vec3& direction) const {
  const Material& material = scene_->materials[point.material];
  if (!material.is_emissive()) return Vec3(0.0F);
  if (!material.two_sided_emission && glm::dot(direction, point.geometric_normal) <= 0.0F) return Vec3(0.0F);
  Vec3 emission = evaluate(*scene_, material.emission, point.coordinates());
  if (material.coat.value > 0.0F) emission *= coat_transmittance(*scene_, material, point, direction);
  return material.emits_vertex_colour ? emission * Vec3(point.colour) : emission;
}

LightSample LightTable::sample(const LightReceiver& receiver, const Vec2& u_light, const Vec2& u) const {
  const LightSelection::Choice choice = selection_.choose(receiver, u_light);
  if (!(choice.probability > 0.0F)) return {};
  const Vec3& from = receiver.position;
  const Light& light = lights_[choice.light];
  LightSample result;
  switch (light.kind) {
    case Kind::triangle:
    case Kind::sphere:
      result = sample_surface(light, from, u);
      break;
    case Kind::punctual:
      result = sample_punctual(scene_->lights[light.instance], from);
      break;
    case Kind::environment: {
      const EnvironmentLight::Sample sky = environment_.sample(u);
      result.direction = sky.direction;
      result.radiance = sky.radiance;
      result.pdf = sky.pdf;
      result.is_infinite = true;
      break;
    }
  }
  result.pdf *= choice.probability;
  return result;
}

LightSample LightTable::sample_punctual(const PunctualLight& light, const Vec3& from) const {
  LightSample result;
  result.pdf = 1.0F;
  result.is_delta = true;
  if (light.kind == PunctualLightKind::directional) {
    result.direction = -light.direction;
    result.radiance = light.intensity;
    result.is_infinite = true;
    return result;
  }
  const Vec3 to_light = light.position - from;
  const float distance_squared = glm::dot(to_light, to_light);
  if (!(distance_squared > 0.0F)) return {};
  result.direction = to_light / std::sqrt(distance_squared);
  const float sent = punctual_falloff(light, -result.direction) * range_window(light, distance_squared);
  // Beyond its range, or outside of its cone: no shadow ray.
  if (!(sent > 0.0F)) return {};
  result.radiance = light.intensity * (sent / distance_squared);
  result.target = light.position;
  return result;
}

LightTable::WorldSphere LightTable::world_sphere(const Light& light, const Vec3& from) const {
  const Instance& instance = scene_->instances[light.instance];
  const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(scene_->objects[instance.object].geometry);
  const SphereSet::Sphere& sphere = spheres.sphere(spheres.first_sphere(light.geometry) + light.primitive);
  WorldSphere result{instance.object_to_world.point(sphere.centre), sphere.radius * similarity_scale(instance.object_to_world), false};
  const Vec3 to_centre = result.centre - from;
  // From within, or just outside where the cone is nearly a hemisphere, area sampling serves better.
  result.is_cone_sampled = result.radius > 0.0F && glm::dot(to_centre, to_centre) > 1.0002F * result.radius * result.radius;
  return result;
}

namespace {

// 1 - cosine of the half-angle of the cone in which a sphere is seen, exact for far spheres.
float cone_height(float radius, float distance_squared) {
  const float sine_squared = radius * radius / distance_squared;
  return sine_squared / (1.0F + std::sqrt(std::max(0.0F, 1.0F - sine_squared)));
}

}  // namespace

LightSample LightTable::sample_surface(const Light& light, const Vec3& from, const Vec2& u) const {
  if (!(light.area > 0.0F)) return {};
  SurfacePoint point;
  if (light.kind == Kind::triangle) {
    point = surfaces_->on_triangle(light.instance, light.geometry, light.primitive, sample_triangle(u));
  } else {
    const WorldSphere sphere = world_sphere(light, from);
    Vec3 normal = sample_sphere(u);
    if (sphere.is_cone_sampled) {
      // A direction in the cone, and the nearer point of the sphere on it.
      const Vec3 to_centre = sphere.centre - from;
      const float distance_squared = glm::dot(to_centre, to_centre);
      const float distance = std::sqrt(distance_squared);
      const float height = u.x * cone_height(sphere.radius, distance_squared);
      const float sine_squared = height * (2.0F - height);
      const float phi = 2.0F * kPi * u.y;
      const float sine = std::sqrt(sine_squared);
      const Frame frame(to_centre / distance);
      const Vec3 direction = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0F - height});
      const float half_chord = std::sqrt(std::max(0.0F, sphere.radius * sphere.radius - distance_squared * sine_squared));
      const float t = distance * (1.0F - height) - half_chord;
      const Instance& instance = scene_->instances[light.instance];
      const Vec3 world_normal = (t * direction - to_centre) / sphere.radius;
      normal = glm::normalize(instance.object_to_world.inverse_vector(world_normal));
    }
    point = surfaces_->on_sphere(light.instance, light.geometry, light.primitive, normal);
  }
  const Vec3 to_light = point.position - from;
  const float distance_squared = glm::dot(to_light, to_light);
  if (!(distance_squared > 0.0F)) return {};
  LightSample result;
  result.direction = to_light / std::sqrt(distance_squared);
  result.radiance = emitted(point, -result.direction);
  result.radiance *= opacity(*scene_, scene_->materials[point.material], point.surface_coordinates());
  if (result.radiance == Vec3(0.0F)) return {};
  result.pdf = surface_pdf(light, from, point);
  result.target = point.offset_origin(-result.direction);
  return result;
}

float LightTable::surface_pdf(const Light& light, const Vec3& from, const SurfacePoint& point) const {
  if (!(light.area > 0.0F)) return 0.0F;
  const Vec3 to_light = point.position - from;
  const float distance_squared = glm::dot(to_light, to_light);
  float area = light.area;
  if (light.kind == Kind::sphere) {
    const WorldSphere sphere = world_sphere(light, from);
    if (sphere.is_cone_sampled) {
      const Vec3 to_centre = sphere.centre - from;
      return 1.0F / (2.0F * kPi * cone_height(sphere.radius, glm::dot(to_centre, to_centre)));
    }
    // Uniform on the sphere as it is in object space: the transform changes areas by |det M| |M^-T n|.
    const Transform& transform = scene_->instances[light.instance].object_to_world;
    const Vec3 object_normal = glm::normalize(glm::transpose(Mat3(transform.matrix())) * point.geometric_normal);
    area *= std::fabs(glm::determinant(Mat3(transform.matrix()))) * glm::length(transform.normal(object_normal));
  }
  const float cosine = std::fabs(glm::dot(to_light, point.geometric_normal)) / std::sqrt(distance_squared);
  const float pdf = distance_squared / (cosine * area);
  return std::isfinite(pdf) ? pdf : 0.0F;
}

float LightTable::pdf_of_hit(const LightReceiver& receiver, const Hit& hit, const SurfacePoint& point) const {
  const std::uint32_t instance = hit.instance == kInvalidId ? 0 : hit.instance;
  const std::uint32_t first = first_light_[first_part_[instance] + hit.geometry];
  if (first == kInvalidId) return 0.0F;
  const std::uint32_t id = first + hit.primitive;
  const float pdf = surface_pdf(lights_[id], receiver.position, point);
  return pdf > 0.0F ? selection_.probability(receiver, id) * pdf : 0.0F;
}

float LightTable::pdf_of_environment(const LightReceiver& receiver, const Vec3& direction) const {
  if (environment_light_ == kInvalidId) return 0.0F;
  return selection_.probability(receiver, environment_light_) * environment_.pdf(direction);
}

}  // namespace grove
