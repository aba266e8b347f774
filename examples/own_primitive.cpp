// A primitive type of your own: tori, met by sphere tracing (Hart 1996, Sphere Tracing). Every structure works over it.

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include "grove/registry/registry.h"

namespace {

// A torus around the z axis of its centre: a tube of radius `minor` along a circle of radius `major`.
struct Torus {
  grove::Vec3 centre;
  float major;
  float minor;
};

class Tori : public grove::UserGeometry {
 public:
  explicit Tori(std::vector<Torus> tori) : tori_(std::move(tori)) {}

  std::size_t size() const override { return tori_.size(); }

  grove::Box bounds(std::size_t i) const override {
    const Torus& torus = tori_[i];
    const float reach = torus.major + torus.minor;
    // Room for the distance at which the march below stops.
    const grove::Vec3 extent = grove::Vec3(reach, reach, torus.minor) + 2 * kTouch;
    return {torus.centre - extent, torus.centre + extent};
  }

  bool intersect_primitive(std::size_t i, const grove::Ray& ray, grove::Hit& hit) const override {
    // Steps are lengths, t counts lengths of the direction.
    const float step_to_t = 1 / glm::length(ray.direction);
    float t = ray.t_min;
    for (int step = 0; step < kMaxSteps && t <= ray.t_max; ++step) {
      const float distance = distance_to(tori_[i], ray.at(t));
      if (distance < kTouch) {
        hit.t = t;
        return true;
      }
      t += distance * step_to_t;
      if (distance > kFar) return false;
    }
    return false;
  }

 private:
  static constexpr float kTouch = 1e-5F;
  static constexpr float kFar = 1e4F;
  static constexpr int kMaxSteps = 256;

  static float distance_to(const Torus& torus, const grove::Vec3& point) {
    const grove::Vec3 p = point - torus.centre;
    return std::hypot(std::hypot(p.x, p.y) - torus.major, p.z) - torus.minor;
  }

  std::vector<Torus> tori_;
};

}  // namespace

int main() {
  // Three tori in a row along z, the nearest to the ray's origin last.
  const auto tori = std::make_shared<Tori>(std::vector<Torus>{{{0, 0, -6}, 1, 0.5F}, {{0, 0, -3}, 1, 0.5F}, {{0, 0, 0}, 1, 0.5F}});
  const auto accelerator = grove::build(std::shared_ptr<const grove::UserGeometry>(tori));

  const grove::Hit hit = accelerator->intersect(grove::Ray{.origin = {1, 0, 3}, .direction = {0, 0, -1}});
  const bool hole = accelerator->occluded(grove::Ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}});
  std::printf("torus %u at t = %.3f; the ray through its hole hits %s\n", hit.primitive, hit.t, hole ? "something" : "nothing");
}
