#include "grove/scene/gltf/lights_cameras.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "grove/scene/animation/placement.h"

namespace grove {
namespace {

constexpr float kWidestSpot = kPi / 2.0F;

PunctualLightKind read_kind(const JsonCursor& place) {
  const std::string kind = place.text();
  if (kind == "point") return PunctualLightKind::point;
  if (kind == "spot") return PunctualLightKind::spot;
  if (kind == "directional") return PunctualLightKind::directional;
  place.fail("is none of point, spot and directional");
}

PunctualLight read_light(const JsonCursor& source) {
  PunctualLight light;
  light.name = source["name"].text();
  light.kind = read_kind(source["type"]);
  light.intensity = source["color"].vec3(Vec3(1.0F)) * source["intensity"].real(1.0F);
  light.range = source["range"].real(light.range);
  const JsonCursor spot = source["spot"];
  const float outer = spot["outerConeAngle"].real(kPi / 4.0F);
  light.outer_angle = std::clamp(outer, 1e-4F, kWidestSpot);
  // The inner cone must lie inside; equal angles would divide by zero where the light fades.
  light.inner_angle = std::clamp(spot["innerConeAngle"].real(0.0F), 0.0F, light.outer_angle * 0.9999F);
  return light;
}

bool has_usable_intensity(const PunctualLight& light) {
  const Vec3& i = light.intensity;
  const bool finite = std::isfinite(i.x) && std::isfinite(i.y) && std::isfinite(i.z);
  return finite && i.x >= 0.0F && i.y >= 0.0F && i.z >= 0.0F;
}

}  // namespace

void read_lights(GltfDocument& document, const GltfNodes& nodes, Scene& scene, GltfMotion& motion) {
  const JsonCursor lights = document.root().extension("KHR_lights_punctual")["lights"];
  for (const GltfNode& node : nodes.shown) {
    const JsonCursor named = document.array("nodes").element(node.id).extension("KHR_lights_punctual")["light"];
    const auto id = named.index(lights.size(), "lights");
    if (!id) continue;
    PunctualLight light = read_light(lights.element(*id));
    if (!(light.range > 0.0F)) {
      light.range = std::numeric_limits<float>::infinity();
      if (document.is_first("light range")) {
        scene.warn("the range of a light must be above 0; those of others are taken for infinite, such as " + lights.element(*id).path());
      }
    }
    if (has_usable_intensity(light) && place_light(node.to_world, light)) {
      motion.follow_light(node.id, scene.lights.size());
      scene.lights.push_back(std::move(light));
    } else if (document.is_first("broken light")) {
      scene.warn("lights without a direction, or with an intensity that is negative or not finite, are left out, such as " + named.path());
    }
  }
}

void read_cameras(GltfDocument& document, const GltfNodes& nodes, Scene& scene, GltfMotion& motion) {
  const JsonCursor cameras = document.array("cameras");
  for (const GltfNode& node : nodes.shown) {
    const JsonCursor node_source = document.array("nodes").element(node.id);
    const auto id = node_source["camera"].index(cameras.size(), "cameras");
    if (!id) continue;
    const JsonCursor source = cameras.element(*id);
    if (source["type"].text() == "orthographic") {
      if (document.is_first("orthographic")) scene.warn("orthographic cameras are left out, such as " + source.path());
      continue;
    }
    Camera camera;
    camera.name = source["name"].text(node_source["name"].text());
    camera.field_of_view = source["perspective"]["yfov"].real(0.0F);
    if (camera.field_of_view > 0.0F && camera.field_of_view < kPi && place_camera(node.to_world, camera)) {
      motion.follow_camera(node.id, scene.cameras.size());
      scene.cameras.push_back(std::move(camera));
    } else if (document.is_first("broken camera")) {
      scene.warn("cameras without a field of view between 0 and pi, or in a node scaled to nothing, are left out, such as " +
                 source.path());
    }
  }
}

}  // namespace grove
