#include "grove/scene/gltf/lights_cameras.h"

#include <algorithm>
#include <cmath>
#include <string>

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

// Lights and cameras look along -z of their node. Zero when the node is scaled to nothing.
Vec3 forward(const Mat4& to_world) {
  const Vec3 axis = -Vec3(to_world[2]);
  const float length = glm::length(axis);
  return length > 0.0F && std::isfinite(length) ? axis / length : Vec3(0.0F);
}

PunctualLight read_light(const JsonCursor& source, const Mat4& to_world) {
  PunctualLight light;
  light.name = source["name"].text();
  light.kind = read_kind(source["type"]);
  light.position = Vec3(to_world[3]);
  light.direction = forward(to_world);
  light.intensity = source["color"].vec3(Vec3(1.0F)) * source["intensity"].real(1.0F);
  const JsonCursor spot = source["spot"];
  const float outer = spot["outerConeAngle"].real(kPi / 4.0F);
  light.outer_angle = std::clamp(outer, 1e-4F, kWidestSpot);
  // The inner cone must lie inside; equal angles would divide by zero where the light fades.
  light.inner_angle = std::clamp(spot["innerConeAngle"].real(0.0F), 0.0F, light.outer_angle * 0.9999F);
  return light;
}

bool is_usable(const PunctualLight& light) {
  const Vec3 sum = light.intensity + light.position;
  const bool finite = std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
  const bool dark = light.intensity.x < 0.0F || light.intensity.y < 0.0F || light.intensity.z < 0.0F;
  return finite && !dark && (light.kind == PunctualLightKind::point || light.direction != Vec3(0.0F));
}

// A camera's node turns and moves it; scale has no part in it. False when the axes do not span the space.
bool remove_scale(Mat4& matrix) {
  for (int axis = 0; axis < 3; ++axis) {
    const float length = glm::length(Vec3(matrix[axis]));
    if (!(length > 0.0F) || !std::isfinite(length)) return false;
    matrix[axis] /= length;
  }
  return std::abs(glm::determinant(Mat3(matrix))) > 1e-6F;
}

}  // namespace

void read_lights(GltfDocument& document, const GltfNodes& nodes, Scene& scene) {
  const JsonCursor lights = document.root().extension("KHR_lights_punctual")["lights"];
  for (const GltfNode& node : nodes.shown) {
    const JsonCursor named = document.array("nodes").element(node.id).extension("KHR_lights_punctual")["light"];
    const auto id = named.index(lights.size(), "lights");
    if (!id) continue;
    PunctualLight light = read_light(lights.element(*id), node.to_world);
    if (is_usable(light)) {
      scene.lights.push_back(std::move(light));
    } else if (document.is_first("broken light")) {
      scene.warn("lights without a direction, or with an intensity that is negative or not finite, are left out, such as " + named.path());
    }
  }
}

void read_cameras(GltfDocument& document, const GltfNodes& nodes, Scene& scene) {
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
    camera.camera_to_world = node.to_world;
    camera.field_of_view = source["perspective"]["yfov"].real(0.0F);
    if (camera.field_of_view > 0.0F && camera.field_of_view < kPi && remove_scale(camera.camera_to_world)) {
      scene.cameras.push_back(std::move(camera));
    } else if (document.is_first("broken camera")) {
      scene.warn("cameras without a field of view between 0 and pi, or in a node scaled to nothing, are left out, such as " +
                 source.path());
    }
  }
}

}  // namespace grove
