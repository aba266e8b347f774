#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/hit_filter.h"
#include "grove/geometry/traceable.h"
#include "grove/math/transform.h"

namespace grove {

/// Instances: each primitive is something traceable (usually an Accelerator) under a transform. So any structure can be a top level and
/// any a bottom level. An instance whose transform cannot be inverted can never be hit.
class InstanceSet {
 public:
  struct Instance {
    std::shared_ptr<const Traceable> object;
    Transform object_to_world;
  };

  /// The ray with what the test against world bounds needs, in double.
  struct PreparedRay {
    Ray ray;
    glm::dvec3 inverse_direction;
  };

  InstanceSet() = default;
  explicit InstanceSet(std::vector<Instance> instances);

  /// Adds an instance and returns its number. Structures over the set must be updated before they are traced again (Accelerator::update).
  std::uint32_t add_instance(Instance instance);
  /// Makes instance i one that can never be hit, and lets go of its object. Numbers stay. As for structures, see above.
  void remove_instance(std::size_t i);
  /// Puts instance i elsewhere; what it refers to stays as it is. As for structures, see above.
  void move_instance(std::size_t i, const Transform& object_to_world);
  /// Measures all instances anew, after objects that they refer to have been updated. O(n).
  void refresh_bounds();

  [[nodiscard]] std::size_t size() const { return instances_.size(); }
  [[nodiscard]] const Instance& instance(std::size_t i) const { return instances_[i]; }

  /// World bounds, with room for the rounding of rays into object space.
  [[nodiscard]] Box bounds(std::size_t i) const { return bounds_[i]; }
  [[nodiscard]] Box clip(std::size_t i, const Box& box) const { return bounds_[i].intersection(box); }
  [[nodiscard]] bool overlaps(std::size_t i, const Box& box) const { return !clip(i, box).is_empty(); }

  [[nodiscard]] static PreparedRay prepare(const Ray& ray);

  /// Traces instance i. t is the same in both spaces, because the direction is not normalised.
  template <typename Counter>
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, Counter& counter) const {
    if constexpr (FiltersHits<Counter>) {
      return intersect(i, ray, hit, counter.filter());
    } else {
      return intersect(i, ray, hit, counter.nested());
    }
  }
  template <typename Counter>
  bool occluded(std::size_t i, const PreparedRay& ray, Counter& counter) const {
    if constexpr (FiltersHits<Counter>) {
      return occluded(i, ray, counter.filter());
    } else {
      return occluded(i, ray, counter.nested());
    }
  }

  void locate(Hit& /*hit*/) const {}

  /// For callers that trace the objects of instances themselves: the ray in the space of instance i, as far as `t_max` and the instance's
  /// bounds reach. Returns false where it cannot hit.
  [[nodiscard]] bool enter(std::size_t i, const PreparedRay& ray, float t_max, Ray& object_ray) const;
  /// Takes what was found in instance i when it is closer, or as close in an earlier instance; returns whether it was.
  static bool take_closer(const Hit& found, std::size_t i, Hit& hit);

 private:
  static void check_size(std::size_t size);
  [[nodiscard]] static Box measure(const Instance& instance);
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, TraversalCounts* counts) const;
  bool occluded(std::size_t i, const PreparedRay& ray, TraversalCounts* counts) const;
  bool intersect(std::size_t i, const PreparedRay& ray, Hit& hit, const HitFilter& filter) const;
  [[nodiscard]] bool occluded(std::size_t i, const PreparedRay& ray, const HitFilter& filter) const;

  std::vector<Instance> instances_;
  std::vector<Box> bounds_;
};

}  // namespace grove
