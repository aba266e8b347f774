#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// The arrays of one part, as generators fill them. Attributes are empty or have one entry a vertex.
struct PartMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;
  std::vector<Vec2> uvs;
  std::vector<Vec4> colours;
  std::vector<Triangle> triangles;
};

/// Puts a scene together: all triangles in one object, all analytic spheres in another, both in world space, y up.
class SceneBuilder {
 public:
  std::uint32_t add_material(Material material);
  void add_mesh(std::string name, PartMesh part, std::uint32_t material);
  void add_spheres(std::string name, std::vector<SphereSet::Sphere> spheres, std::uint32_t material);
  /// A texture of two colours by turns; `squares` of them along a unit of u and v.
  std::uint32_t add_checkerboard(const Vec3& even, const Vec3& odd, float squares);
  /// A sky that goes from `horizon` to `zenith`, over a ground of one colour.
  void set_sky(const Vec3& zenith, const Vec3& horizon, const Vec3& ground);
  void set_constant_sky(const Vec3& radiance) { scene_.environment.radiance = radiance; }
  /// Sunlight that travels along `direction`.
  void add_sun(const Vec3& direction, const Vec3& irradiance);

  /// A light without area, with all its fields.
  void add_light(PunctualLight light) { scene_.lights.push_back(std::move(light)); }

  [[nodiscard]] Scene finish(Camera camera, FilmRequest film = {});

 private:
  Scene scene_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  std::shared_ptr<SphereSet> spheres_ = std::make_shared<SphereSet>();
  std::vector<Part> mesh_parts_;
  std::vector<Part> sphere_parts_;
};

[[nodiscard]] Material matte(const Vec3& colour);
/// Dielectric over a diffuse base; `roughness` is perceptual.
[[nodiscard]] Material plastic(const Vec3& colour, float roughness);
[[nodiscard]] Material metal(const Vec3& colour, float roughness);
[[nodiscard]] Material glass();
/// Emits on the side of the geometric normal and reflects nothing.
[[nodiscard]] Material lamp(const Vec3& radiance);

}  // namespace grove
