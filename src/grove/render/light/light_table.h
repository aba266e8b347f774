#pragma once

#include <cstdint>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/render/light/environment_light.h"
#include "grove/render/light/light_receiver.h"
#include "grove/render/light/light_sampling.h"
#include "grove/render/light/light_selection.h"
#include "grove/render/surface/surface_table.h"
#include "grove/scene/scene.h"

namespace grove {

/// A way to the light from a point.
struct LightSample {
  /// Unit length, towards the light.
  Vec3 direction{0.0F};
  /// Radiance that arrives, before anything in between; for lights without area irradiance on a surface that faces them.
  Vec3 radiance{0.0F};
  /// Chance of the light times density over solid angle; for lights without area the chance alone. No sample when 0.
  float pdf = 0.0F;
  /// Without area: no other technique can find it.
  bool is_delta = false;
  /// Infinitely far; else the shadow ray ends at `target`, which is moved off the light's own surface already.
  bool is_infinite = false;
  Vec3 target{0.0F};
};

/// All lights of a scene, ready to be chosen and sampled: emissive triangles and spheres, punctual lights, the environment.
///
/// One light is chosen as light_sampling.h says.
class LightTable {
 public:
  /// Refers to `scene` and `surfaces`. A scene without any light is given a sky. O(lights log lights), parallel in the caller's oneTBB arena.
  LightTable(const Scene& scene, const SurfaceTable& surfaces, LightSampling sampling = LightSampling::hierarchy);

  /// Finds all lights again after some have moved. The environment is kept, which does not move: its table is most of the work. O(lights log lights), parallel in the caller's
  /// oneTBB arena; not while others use the table.
  void gather();

  [[nodiscard]] LightSampling sampling() const { return sampling_; }

  [[nodiscard]] const EnvironmentLight& environment() const { return environment_; }
  /// Whether the sky is the default one.
  [[nodiscard]] bool has_default_sky() const { return has_default_sky_; }
  [[nodiscard]] std::size_t size() const { return lights_.size(); }

  /// Chooses a light by `u_light` (whose second coordinate refines the first) and a point on it by `u`, as seen by `receiver`.
  [[nodiscard]] LightSample sample(const LightReceiver& receiver, const Vec2& u_light, const Vec2& u) const;

  /// The density with which `sample` for the same receiver gives the emissive point that a ray hit; 0 where it does not.
  [[nodiscard]] float pdf_of_hit(const LightReceiver& receiver, const Hit& hit, const SurfacePoint& point) const;
  /// The same for the environment in a direction.
  [[nodiscard]] float pdf_of_environment(const LightReceiver& receiver, const Vec3& direction) const;

  /// The chance that `sample` takes light `number` of `size`.
  [[nodiscard]] float chance_of(const LightReceiver& receiver, std::uint32_t number) const {
    return selection_.probability(receiver, number);
  }

  /// The radiance that a surface point sends towards `direction` (unit length).
  [[nodiscard]] Vec3 emitted(const SurfacePoint& point, const Vec3& direction) const;

 private:
  enum class Kind : std::uint8_t { triangle, sphere, punctual, environment };
  struct Light {
    Kind kind = Kind::triangle;
    std::uint32_t instance = 0;   // punctual: index into Scene::lights
    std::uint32_t geometry = 0;   // part
    std::uint32_t primitive = 0;  // in the part
    float area = 0.0F;            // world; spheres: of the undistorted one
  };

  // Lights while they are gathered: `descriptions` has one entry a light, `groups` cover them in order.
  struct Gathered {
    std::vector<LightDescription> descriptions;
    std::vector<LightChoice::Group> groups;
  };
  void add_surfaces(Gathered& gathered);
  void add_part(std::uint32_t instance, std::uint32_t part, Gathered& gathered);
  void add_punctual(Gathered& gathered);
  [[nodiscard]] LightSample sample_surface(const Light& light, const Vec3& from, const Vec2& u) const;
  [[nodiscard]] LightSample sample_punctual(const PunctualLight& light, const Vec3& from) const;
  // Density over solid angle, without the chance of the light.
  [[nodiscard]] float surface_pdf(const Light& light, const Vec3& from, const SurfacePoint& point) const;
  // A sphere as a sphere in world space, and whether `from` sees it from outside so that its cone can be sampled.
  struct WorldSphere {
    Vec3 centre{0.0F};
    float radius = 0.0F;
    bool is_cone_sampled = false;
  };
  [[nodiscard]] WorldSphere world_sphere(const Light& light, const Vec3& from) const;

  const Scene* scene_;
  const SurfaceTable* surfaces_;
  LightSampling sampling_;
  EnvironmentLight environment_;
  bool has_default_sky_ = false;
  std::vector<Light> lights_;
  LightSelection selection_;
  std::uint32_t environment_light_ = kInvalidId;
  // first_light_[first_part_[instance] + geometry] is the light of the part's first primitive, or kInvalidId.
  std::vector<std::uint32_t> first_part_;
  std::vector<std::uint32_t> first_light_;
};

}  // namespace grove
