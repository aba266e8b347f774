#include "grove/base/timer.h"
#include "grove/scene/load.h"
#include "grove/scene/pbrt/camera_builder.h"
#include "grove/scene/pbrt/directives.h"
#include "grove/scene/pbrt/light_builder.h"
#include "grove/scene/pbrt/material_builder.h"
#include "grove/scene/pbrt/object_builder.h"
#include "grove/scene/pbrt/texture_builder.h"

namespace grove {

Scene load_pbrt(const std::filesystem::path& file) {
  const Timer timer;
  pbrt::Warnings warnings;
  pbrt::Context context{file.parent_path(), warnings};
  pbrt::DirectiveReader reader(context);
  reader.read_file(file, pbrt::Place{std::make_shared<const std::string>(file.string()), 0});
  const pbrt::Description description = std::move(reader).finish();

  Scene scene;
  scene.name = file.filename().string();
  pbrt::build_camera(description, scene, context);
  pbrt::TextureBuilder textures(description, scene, context);
  pbrt::MaterialBuilder materials(description, textures, scene, context);
  pbrt::build_objects(description, materials, scene, context);
  pbrt::build_lights(description, textures, scene, context);
  scene.warnings = warnings.lines();
  scene.validate(file.string());
  scene.load_seconds = timer.seconds();
  return scene;
}

}  // namespace grove
