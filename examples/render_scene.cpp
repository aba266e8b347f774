// Make a picture of a scene.

#include <cstdio>

#include "grove/base/error.h"
#include "grove/render/render.h"
#include "grove/scene/load.h"

int main() try {
  const grove::Scene scene = grove::load_scene("builtin:cornell");
  const grove::SceneAccelerator accelerator(scene, "bvh");
  const grove::RenderResult picture =
      grove::render(scene, accelerator, grove::RenderSettings{.width = 64, .height = 64, .samples_per_pixel = 4});

  const grove::Vec3 centre = picture.film.mean(32, 32).radiance;
  std::printf("%u x %u pixels, lit: %s\n", picture.film.width(), picture.film.height(), centre.y > 0 ? "yes" : "no");
} catch (const grove::Error& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 1;
}
