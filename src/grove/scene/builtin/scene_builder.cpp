#include "grove/scene/builtin/scene_builder.h"

#include <utility>

namespace grove {

std::uint32_t SceneBuilder::add_material(Material material) {
  scene_.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

void SceneBuilder::add_mesh(std::string name, PartMesh part, std::uint32_t material) {
  mesh_->add_part(std::move(part.vertices), std::move(part.triangles));
  Part& added = mesh_parts_.emplace_back();
  added.name = std::move(name);
  added.material = material;
  added.normals = std::move(part.normals);
  added.uvs = std::move(part.uvs);
  added.colours = std::move(part.colours);
}

void SceneBuilder::add_spheres(std::string name, std::vector<SphereSet::Sphere> spheres, std::uint32_t material) {
  spheres_->add_part(std::move(spheres));
  Part& added = sphere_parts_.emplace_back();
  added.name = std::move(name);
  added.material = material;
}

std::uint32_t SceneBuilder::add_checkerboard(const Vec3& even, const Vec3& odd, float squares) {
  Texture texture;
  texture.name = "checkerboard";
  texture.kind = TextureKind::checkerboard;
  texture.value[0] = Vec4(even, 1.0F);
  texture.value[1] = Vec4(odd, 1.0F);
  texture.uv_transform = Mat3(Vec3(squares, 0.0F, 0.0F), Vec3(0.0F, squares, 0.0F), Vec3(0.0F, 0.0F, 1.0F));
  scene_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(scene_.textures.size() - 1);
}

void SceneBuilder::set_sky(const Vec3& zenith, const Vec3& horizon, const Vec3& ground) {
  constexpr std::uint32_t width = 4;  // the same all around
  constexpr std::uint32_t height = 128;
  auto image = std::make_shared<Image>();
  image->name = "sky";
  image->width = width;
  image->height = height;
  image->channels = 3;
  image->floats.reserve(std::size_t{3} * width * height);
  for (std::uint32_t row = 0; row < height; ++row) {
    // 1 at the zenith, 0 at the horizon; squared, because haze lies low.
    const float up = 1.0F - (static_cast<float>(row) + 0.5F) / (0.5F * static_cast<float>(height));
    const float clear = 1.0F - (1.0F - up) * (1.0F - up);
    const Vec3 colour = up < 0.0F ? ground : horizon + clear * (zenith - horizon);
    for (std::uint32_t column = 0; column < width; ++column) {
      for (int channel = 0; channel < 3; ++channel) image->floats.push_back(colour[channel]);
    }
  }
  scene_.environment.radiance = Vec3(1.0F);
  scene_.environment.image = static_cast<std::uint32_t>(scene_.images.size());
  scene_.images.push_back(std::move(image));
}

void SceneBuilder::add_sun(const Vec3& direction, const Vec3& irradiance) {
  PunctualLight sun;
  sun.name = "sun";
  sun.kind = PunctualLightKind::directional;
  sun.direction = glm::normalize(direction);
  sun.intensity = irradiance;
  scene_.lights.push_back(std::move(sun));
}

Scene SceneBuilder::finish(Camera camera, FilmRequest film) {
  const auto place = [&](const char* name, auto geometry, std::vector<Part>&& parts) {
    if (parts.empty()) return;
    const auto id = static_cast<std::uint32_t>(scene_.objects.size());
    scene_.objects.push_back({.name = name, .geometry = std::move(geometry), .parts = std::move(parts)});
    scene_.instances.push_back({.name = name, .object = id, .object_to_world = Transform()});
  };
  place("triangles", std::move(mesh_), std::move(mesh_parts_));
  place("spheres", std::move(spheres_), std::move(sphere_parts_));
  camera.name = "default";
  scene_.cameras.push_back(std::move(camera));
  scene_.film = film;
  return std::move(scene_);
}

Material matte(const Vec3& colour) {
  Material material;
  material.name = "matte";
  material.kind = MaterialKind::diffuse;
  material.base_colour.value = colour;
  return material;
}

Material plastic(const Vec3& colour, float roughness) {
  Material material;
  material.name = "plastic";
  material.base_colour.value = colour;
  material.roughness.value = roughness;
  return material;
}

Material metal(const Vec3& colour, float roughness) {
  Material material = plastic(colour, roughness);
  material.name = "metal";
  material.metallic.value = 1.0F;
  return material;
}

Material glass() {
  Material material;
  material.name = "glass";
  material.kind = MaterialKind::dielectric;
  material.roughness.value = 0.0F;
  return material;
}

Material lamp(const Vec3& radiance) {
  Material material = matte(Vec3(0.0F));
  material.name = "lamp";
  material.emission.value = radiance;
  material.two_sided_emission = false;
  return material;
}

}  // namespace grove
