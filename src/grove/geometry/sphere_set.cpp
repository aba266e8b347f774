#include "grove/geometry/sphere_set.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "grove/base/check.h"
#include "grove/base/error.h"
#include "grove/geometry/part_table.h"

namespace grove {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kPiDouble = 3.14159265358979323846;

bool is_hittable(const SphereSet::Sphere& sphere) {
  return sphere.radius > 0.0F && sphere.radius <= 0.5F * kMaxCoordinate && Ray::is_within(sphere.centre, 0.5F * kMaxCoordinate);
}

// The nearer crossing with t in [t_min, t_max], in double: a sphere seen from afar loses its shape in float (the squared distance
// swallows the squared radius). The half-chord is taken from the foot point's distance (Haines, Günther, Akenine-Möller, "Precision
// Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019).
float crossing(const SphereSet::Sphere& sphere, const SphereSet::PreparedRay& prepared, float t_max) {
  const glm::dvec3 direction(prepared.ray.direction);
  const glm::dvec3 to_centre = glm::dvec3(sphere.centre) - glm::dvec3(prepared.ray.origin);
  const double t_foot = glm::dot(to_centre, direction) * prepared.inverse_length_squared;
  const glm::dvec3 from_foot = to_centre - t_foot * direction;
  const double radius = sphere.radius;
  const double left = radius * radius - glm::dot(from_foot, from_foot);
  if (!(left >= 0.0)) return kInfinity;
  const double half_chord = std::sqrt(left * prepared.inverse_length_squared);
  const float t_min = prepared.ray.t_min > 0.0F ? prepared.ray.t_min : 0.0F;
  const auto entry = static_cast<float>(t_foot - half_chord);
  if (entry >= t_min && entry <= t_max) return entry;
  const auto exit = static_cast<float>(t_foot + half_chord);
  return exit >= t_min && exit <= t_max ? exit : kInfinity;
}

}  // namespace

SphereSet::SphereSet(std::vector<Sphere> spheres) {
  add_part(std::move(spheres));
}

void SphereSet::check_size(std::size_t size) {
  if (size >= kInvalidId) throw InputError("a set may have at most 2^32 - 2 spheres");
}

std::uint32_t SphereSet::add_part(std::vector<Sphere> spheres) {
  check_size(spheres_.size() + spheres.size());
  part_first_.push_back(static_cast<std::uint32_t>(spheres_.size()));
  if (spheres_.empty()) {
    spheres_ = std::move(spheres);
  } else {
    spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
  }
  return static_cast<std::uint32_t>(part_first_.size() - 1);
}

std::uint32_t SphereSet::extend_last_part(std::span<const Sphere> spheres) {
  GROVE_CHECK(part_count() > 0);
  check_size(spheres_.size() + spheres.size());
  const auto first = static_cast<std::uint32_t>(spheres_.size());
  spheres_.insert(spheres_.end(), spheres.begin(), spheres.end());
  return first;
}

void SphereSet::move_spheres(std::vector<Sphere> spheres) {
  if (spheres.size() != spheres_.size())
    throw InputError("the set has " + std::to_string(spheres_.size()) + " spheres, but " + std::to_string(spheres.size()) + " are given");
  spheres_ = std::move(spheres);
}

Box SphereSet::bounds(std::size_t i) const {
  const Sphere& sphere = spheres_[i];
  if (!is_hittable(sphere)) return {};
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::nextafter(sphere.centre[axis] - sphere.radius, -kInfinity);
    box.upper[axis] = std::nextafter(sphere.centre[axis] + sphere.radius, kInfinity);
  }
  return box;
}

Box SphereSet::clip(std::size_t i, const Box& box) const {
  const Box overlap = bounds(i).intersection(box);
  if (overlap.is_empty()) return {};
  // The surface misses a box that is wholly outside (Arvo 1990, "A Simple Method for Box-Sphere Intersection Testing") or wholly inside.
  const Sphere& sphere = spheres_[i];
  double nearest = 0.0;
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = static_cast<double>(box.lower[axis]) - sphere.centre[axis];
    const double above = static_cast<double>(box.upper[axis]) - sphere.centre[axis];
    const double gap = std::fmax(0.0, std::fmax(below, -above));
    const double reach = std::fmax(std::fabs(below), std::fabs(above));
    nearest += gap * gap;
    farthest += reach * reach;
  }
  const double squared = static_cast<double>(sphere.radius) * sphere.radius;
  // The margin covers hits whose t was rounded to float.
  if (nearest > squared * (1.0 + 1e-6) || farthest < squared * (1.0 - 1e-6)) return {};
  return overlap;
}

double SphereSet::surface_area(std::size_t i) const {
  const double radius = spheres_[i].radius;
  return is_hittable(spheres_[i]) ? 4.0 * kPiDouble * radius * radius : 0.0;
}

glm::dvec3 SphereSet::surface_point(std::size_t i, double u, double v) const {
  // Slices of equal height have equal area (Archimedes).
  const double z = 1.0 - 2.0 * u;
  const double from_axis = std::sqrt(std::fmax(0.0, 1.0 - z * z));
  const double azimuth = 2.0 * kPiDouble * v;
  const glm::dvec3 direction(from_axis * std::cos(azimuth), from_axis * std::sin(azimuth), z);
  return glm::dvec3(spheres_[i].centre) + static_cast<double>(spheres_[i].radius) * direction;
}

SphereSet::PreparedRay SphereSet::prepare(const Ray& ray) {
  const glm::dvec3 direction(ray.direction);
  return {ray, 1.0 / glm::dot(direction, direction)};
}

bool SphereSet::intersect(std::size_t i, const PreparedRay& ray, Hit& hit) const {
  const Sphere& sphere = spheres_[i];
  const float t = crossing(sphere, ray, hit.t);
  const auto id = static_cast<std::uint32_t>(i);
  if (!is_closer(t, id, hit) || !is_hittable(sphere)) return false;
  const glm::dvec3 point = glm::dvec3(ray.ray.origin) + static_cast<double>(t) * glm::dvec3(ray.ray.direction);
  const glm::dvec3 normal = glm::normalize(point - glm::dvec3(sphere.centre));
  const double azimuth = std::atan2(normal.y, normal.x) / (2.0 * kPiDouble);
  hit.t = t;
  hit.u = static_cast<float>(azimuth < 0.0 ? azimuth + 1.0 : azimuth);
  hit.v = static_cast<float>(std::acos(std::fmin(1.0, std::fmax(-1.0, normal.z))) / kPiDouble);
  hit.primitive = id;
  return true;
}

bool SphereSet::occluded(std::size_t i, const PreparedRay& ray) const {
  return crossing(spheres_[i], ray, ray.ray.t_max) < kInfinity && is_hittable(spheres_[i]);
}

void SphereSet::locate(Hit& hit) const {
  locate_in_parts(part_first_, hit);
}

}  // namespace grove
