#include "grove/geometry/instance_set.h"

#include <cmath>
#include <limits>
#include <utility>

#include "grove/base/error.h"

namespace grove {
namespace {

// At least a step of the last place down or up, as std::nextafter, which is a call to the library; not a number where the step is infinite.
float step(float v) {
  const float s = std::fabs(v) * 0x1p-23F;
  return s > 0.0F ? s : std::numeric_limits<float>::denorm_min();
}
float next_below(float v) {
  return v - step(v);
}
float next_above(float v) {
  return v + step(v);
}

// Leaves of the ray what is inside an instance's world bounds; returns whether there is anything. A hit is looked for in this stretch only, so that
// whether it is found does not depend on how a structure above came to the instance. (Comparisons in place of std::fmin and std::fmax, which are calls
// as well; nothing here is NaN before the end.)
bool clip_to_bounds(const InstanceSet::PreparedRay& prepared, const Box& bounds, float t_max, Ray& clipped) {
  double near = prepared.ray.t_min > 0.0F ? prepared.ray.t_min : 0.0F;
  double far = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = prepared.inverse_direction[axis];
    const double low = static_cast<double>(bounds.lower[axis]) - prepared.ray.origin[axis];
    const double high = static_cast<double>(bounds.upper[axis]) - prepared.ray.origin[axis];
    if (std::isinf(inverse)) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    const double enters = (inverse > 0.0 ? low : high) * inverse;
    const double leaves = (inverse > 0.0 ? high : low) * inverse;
    near = enters > near ? enters : near;
    far = leaves < far ? leaves : far;
  }
  if (!(near <= far)) return false;
  // Rounded outward, but never beyond the ray itself.
  const float from = next_below(static_cast<float>(near));
  const float to = next_above(static_cast<float>(far));
  clipped = prepared.ray;
  clipped.t_min = from > prepared.ray.t_min ? from : prepared.ray.t_min;
  clipped.t_max = to < t_max ? to : t_max;
  return clipped.t_min <= clipped.t_max;
}

// Into object space. t keeps its meaning, because the direction is transformed without being normalised.
Ray to_object(const Ray& ray, const Transform& transform) {
  if (transform.is_identity()) return ray;
  Ray result = ray;
  result.origin = transform.inverse_point(ray.origin);
  result.direction = transform.inverse_vector(ray.direction);
  return result;
}

// A filter as the object of one instance sees it: hits are told with the instance's number.
class InstanceFilter {
 public:
  InstanceFilter(const HitFilter& outer, std::size_t i) : outer_(outer), instance_(static_cast<std::uint32_t>(i)) {}

  [[nodiscard]] HitFilter filter() { return {accept, this}; }

 private:
  static bool accept(void* context, const Hit& hit) {
    const auto& self = *static_cast<const InstanceFilter*>(context);
    Hit whole = hit;
    whole.instance = self.instance_;
    return self.outer_(whole);
  }

  const HitFilter& outer_;
  std::uint32_t instance_;
};

}  // namespace

void InstanceSet::check_size(std::size_t size) {
  if (size >= kInvalidId) throw InputError("a scene may have at most 2^32 - 2 instances");
}

InstanceSet::InstanceSet(std::vector<Instance> instances) : instances_(std::move(instances)) {
  check_size(instances_.size());
  refresh_bounds();
}

std::uint32_t InstanceSet::add_instance(Instance instance) {
  check_size(instances_.size() + 1);
  bounds_.push_back(measure(instance));
  instances_.push_back(std::move(instance));
  return static_cast<std::uint32_t>(instances_.size() - 1);
}

void InstanceSet::remove_instance(std::size_t i) {
  instances_[i].object.reset();
  bounds_[i] = {};
}

void InstanceSet::move_instance(std::size_t i, const Transform& object_to_world) {
  instances_[i].object_to_world = object_to_world;
  bounds_[i] = measure(instances_[i]);
}

void InstanceSet::refresh_bounds() {
  bounds_.resize(instances_.size());
  for (std::size_t i = 0; i < instances_.size(); ++i) bounds_[i] = measure(instances_[i]);
}

Box InstanceSet::measure(const Instance& instance) {
  Box box;
  if (instance.object && instance.object_to_world.is_invertible()) box = instance.object_to_world.box(instance.object->bounds());
  // As for triangles: what lies beyond the limit, or overflows, cannot be hit.
  const bool usable = Ray::is_within(box.lower, kMaxCoordinate) && Ray::is_within(box.upper, kMaxCoordinate);
  return usable ? box : Box{};
}

InstanceSet::PreparedRay InstanceSet::prepare(const Ray& ray) {
  return {ray, 1.0 / glm::dvec3(ray.direction)};
}

bool InstanceSet::take_closer(const Hit& found, std::size_t i, Hit& hit) {
  const auto id = static_cast<std::uint32_t>(i);
  if (!found || !(found.t < hit.t || (found.t == hit.t && id < hit.instance))) return false;
  hit = found;
  hit.instance = id;
  return true;
}

bool InstanceSet::enter(std::size_t i, const PreparedRay& ray, float t_max, Ray& object_ray) const {
  if (bounds_[i].is_empty()) return false;
  Ray clipped;
  if (!clip_to_bounds(ray, bounds_[i], t_max, clipped)) return false;
  object_ray = to_object(clipped, instances_[i].object_to_world);
  return true;
}

bool InstanceSet::intersect(std::size_t i, const PreparedRay& ray, Hit& hit, TraversalCounts* counts) const {
  Ray object_ray;
  return enter(i, ray, hit.t, object_ray) && take_closer(instances_[i].object->closest_hit(object_ray, counts), i, hit);
}

bool InstanceSet::occluded(std::size_t i, const PreparedRay& ray, TraversalCounts* counts) const {
  Ray object_ray;
  return enter(i, ray, ray.ray.t_max, object_ray) && instances_[i].object->any_hit(object_ray, counts);
}

bool InstanceSet::intersect(std::size_t i, const PreparedRay& ray, Hit& hit, const HitFilter& filter) const {
  Ray object_ray;
  if (!enter(i, ray, hit.t, object_ray)) return false;
  InstanceFilter below(filter, i);
  return take_closer(instances_[i].object->closest_hit(object_ray, below.filter()), i, hit);
}

bool InstanceSet::occluded(std::size_t i, const PreparedRay& ray, const HitFilter& filter) const {
  Ray object_ray;
  if (!enter(i, ray, ray.ray.t_max, object_ray)) return false;
  InstanceFilter below(filter, i);
  return instances_[i].object->any_hit(object_ray, below.filter());
}

}  // namespace grove
