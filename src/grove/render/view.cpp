#include "grove/render/view.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "grove/base/error.h"
#include "grove/render/camera_rays.h"
#include "grove/render/picture_part.h"
#include "grove/render/render.h"

namespace grove {
namespace {

void choose_size(const Scene& scene, const RenderSettings& settings, View& view) {
  View natural{scene.film.width, scene.film.height, {}};
  if (natural.width == 0 || natural.height == 0) natural = {1280, 720, {}};
  view.width = settings.width;
  view.height = settings.height;
  const double aspect = static_cast<double>(natural.width) / natural.height;
  const auto side = [](double pixels) {
    return static_cast<std::uint32_t>(std::clamp(std::round(pixels), 1.0, double{TileGrid::kMaxSide} + 1.0));
  };
  if (view.width == 0 && view.height == 0) {
    view.width = natural.width;
    view.height = natural.height;
  } else if (view.width == 0) {
    view.width = side(view.height * aspect);
  } else if (view.height == 0) {
    view.height = side(view.width / aspect);
  }
  if (!TileGrid::is_possible(view.width, view.height)) {
    throw UsageError("a picture of " + std::to_string(view.width) + " x " + std::to_string(view.height) +
                     " pixels is too large; the limit is 65536 a side and 2^28 in all");
  }
}

std::string list_cameras(const Scene& scene) {
  std::string names;
  for (const Camera& camera : scene.cameras) names += (names.empty() ? "'" : ", '") + camera.name + "'";
  return names.empty() ? "the scene has none; leave the name out for a view of all of it" : "there are " + names;
}

Camera choose_camera(const Scene& scene, const RenderSettings& settings, const View& view) {
  if (settings.viewpoint) return *settings.viewpoint;
  if (!settings.camera.empty()) {
    for (const Camera& camera : scene.cameras)
      if (camera.name == settings.camera) return camera;
    throw UsageError("no camera is named '" + settings.camera + "': " + list_cameras(scene));
  }
  if (!scene.cameras.empty()) return scene.cameras.front();
  return frame_bounds(scene.bounds(), static_cast<float>(view.width) / static_cast<float>(view.height));
}

}  // namespace

View choose_view(const Scene& scene, const RenderSettings& settings) {
  View view;
  choose_size(scene, settings, view);
  view.camera = choose_camera(scene, settings, view);
  return view;
}

}  // namespace grove
