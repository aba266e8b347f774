#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "grove/render/render.h"
#include "grove/scene/scene.h"

namespace grove::testing {

/// Builds small scenes by hand.
class SceneMaker {
 public:
  std::uint32_t material(const Material& material) {
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  static Material diffuse(const Vec3& colour) {
    Material material;
    material.kind = MaterialKind::diffuse;
    material.base_colour.value = colour;
    return material;
  }

  static Material lamp(const Vec3& radiance, bool two_sided = false) {
    Material material = diffuse(Vec3(0.0F));
    material.emission.value = radiance;
    material.two_sided_emission = two_sided;
    return material;
  }

  /// A parallelogram, outer side cross(a, b), texture coordinates (0, 0) at the corner, u along a.
  void quad(const Vec3& corner, const Vec3& a, const Vec3& b, std::uint32_t material) {
    Part part;
    part.material = material;
    part.uvs = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    mesh_->add_part({corner, corner + a, corner + a + b, corner + b}, {{0, 1, 2}, {0, 2, 3}});
    mesh_parts_.push_back(part);
  }

  /// An analytic sphere under a transform, as an object of its own.
  void sphere(const SphereSet::Sphere& sphere, std::uint32_t material, const Mat4& transform = Mat4(1.0F)) {
    Object object;
    object.geometry = std::make_shared<SphereSet>(std::vector<SphereSet::Sphere>{sphere});
    object.parts.emplace_back().material = material;
    scene_.objects.push_back(std::move(object));
    scene_.instances.push_back({"", static_cast<std::uint32_t>(scene_.objects.size() - 1), Transform(transform)});
  }

  void camera(const Vec3& eye, const Vec3& target, float field_of_view = 0.6F, const Vec3& up = Vec3(0.0F, 1.0F, 0.0F)) {
    scene_.cameras.push_back(look_at(eye, target, up, field_of_view));
  }

  Scene& scene() { return scene_; }

  /// The scene, valid; call once.
  Scene make() {
    if (!mesh_parts_.empty()) {
      Object object;
      object.geometry = mesh_;
      object.parts = std::move(mesh_parts_);
      scene_.objects.push_back(std::move(object));
      scene_.instances.push_back({"", static_cast<std::uint32_t>(scene_.objects.size() - 1), Transform()});
    }
    scene_.validate("test scene");
    return std::move(scene_);
  }

 private:
  Scene scene_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  std::vector<Part> mesh_parts_;
};

inline RenderSettings small_settings(std::uint32_t side, std::uint32_t samples, std::uint32_t max_depth = 8) {
  RenderSettings settings;
  settings.width = side;
  settings.height = side;
  settings.samples_per_pixel = samples;
  settings.max_depth = max_depth;
  return settings;
}

inline RenderResult render_scene(const Scene& scene, const RenderSettings& settings, const char* spec = "bvh") {
  return render(scene, SceneAccelerator(scene, spec), settings);
}

/// Mean radiance over the whole picture.
inline Vec3 mean_radiance(const RenderResult& result) {
  Vec3 sum(0.0F);
  for (std::uint32_t y = 0; y < result.film.height(); ++y)
    for (std::uint32_t x = 0; x < result.film.width(); ++x) sum += result.film.mean(x, y).radiance;
  return sum / static_cast<float>(result.film.width() * result.film.height());
}

/// A small room with a bit of everything: lamp, glossy, glass, mirror, texture, instance, alpha.
inline Scene mixed_scene() {
  SceneMaker maker;
  const std::uint32_t white = maker.material(SceneMaker::diffuse({0.7F, 0.7F, 0.7F}));
  const std::uint32_t red = maker.material(SceneMaker::diffuse({0.7F, 0.1F, 0.1F}));
  const std::uint32_t lamp = maker.material(SceneMaker::lamp(Vec3(9.0F, 8.0F, 6.0F)));
  Material glass;
  glass.kind = MaterialKind::dielectric;
  glass.roughness.value = 0.0F;
  Material gold;
  gold.kind = MaterialKind::conductor;
  gold.base_colour.value = {1.0F, 0.7F, 0.3F};
  gold.roughness.value = 0.35F;
  Material paint;
  paint.kind = MaterialKind::coated_diffuse;
  paint.base_colour.value = {0.1F, 0.3F, 0.7F};
  paint.roughness.value = 0.1F;
  Material veil = SceneMaker::diffuse({0.2F, 0.6F, 0.2F});
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha.value = 0.4F;
  const std::uint32_t glass_id = maker.material(glass);
  const std::uint32_t gold_id = maker.material(gold);
  const std::uint32_t paint_id = maker.material(paint);
  const std::uint32_t veil_id = maker.material(veil);
  maker.quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, white);
  maker.quad({-2, 0, -2}, {4, 0, 0}, {0, 4, 0}, white);
  maker.quad({-2, 0, -2}, {0, 4, 0}, {0, 0, 4}, red);
  maker.quad({-0.6F, 3.9F, -0.6F}, {1.2F, 0, 0}, {0, 0, 1.2F}, lamp);
  maker.quad({0.2F, 0.1F, 1.0F}, {1.2F, 0, 0.2F}, {0, 1.5F, 0}, veil_id);
  maker.sphere({{-0.9F, 0.6F, 0.3F}, 0.6F}, glass_id);
  maker.sphere({{0.0F, 0.0F, 0.0F}, 1.0F}, gold_id,
               Mat4(Vec4(0.7F, 0, 0, 0), Vec4(0, 0.5F, 0, 0), Vec4(0, 0.2F, 0.6F, 0), Vec4(0.9F, 0.6F, -0.5F, 1.0F)));
  maker.sphere({{-0.2F, 0.3F, 1.2F}, 0.3F}, paint_id);
  maker.scene().environment.radiance = Vec3(0.05F, 0.06F, 0.08F);
  maker.camera({0.5F, 2.0F, 6.5F}, {0.0F, 1.2F, 0.0F}, 0.7F);
  return maker.make();
}

}  // namespace grove::testing
