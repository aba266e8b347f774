#include "session.h"

#include <fmt/format.h>

#include "grove/base/timer.h"
#include "grove/lab/auto_choice.h"
#include "grove/lab/text_table.h"
#include "grove/scene/load.h"
#include "grove/scene/load_animated.h"

namespace grove::app {
namespace {

std::string counted(std::uint64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", with_separators(count), thing, count == 1 ? "" : "s");
}

std::string scene_summary(const Scene& scene) {
  std::string text = counted(scene.primitive_count(), "primitive");
  if (scene.stored_primitive_count() != scene.primitive_count()) {
    text += fmt::format(" ({} stored, in {} and {})", with_separators(scene.stored_primitive_count()),
                        counted(scene.objects.size(), "object"), counted(scene.instances.size(), "instance"));
  }
  text += ", " + counted(scene.materials.size(), "material");
  if (!scene.textures.empty()) text += ", " + counted(scene.textures.size(), "texture");
  if (!scene.lights.empty()) text += ", " + counted(scene.lights.size(), "light");
  if (!scene.cameras.empty()) text += ", " + counted(scene.cameras.size(), "camera");
  return text;
}

void tell_of(const Scene& scene, const std::string& source, const Console& console) {
  console.say(fmt::format("scene      {}: {}; read in {}", source, scene_summary(scene), duration(scene.load_seconds)));
  for (const std::string& warning : scene.warnings) console.warn(warning);
}

}  // namespace

unsigned arena_threads() {
  return static_cast<unsigned>(oneapi::tbb::this_task_arena::max_concurrency());
}

Scene load(const std::string& source, const Console& console) {
  console.status("reading " + source);
  Scene scene = load_scene(source);
  tell_of(scene, source, console);
  return scene;
}

AnimatedScene load_animated(const std::string& source, const std::string& animation, const Console& console) {
  console.status("reading " + source);
  AnimatedScene scene = load_animated_scene(source, animation);
  tell_of(scene.scene(), source, console);
  return scene;
}

BuiltStructure build_structure(const Scene& scene, const std::string& spec, const Console& console) {
  if (const auto choice = auto_choice(scene, spec)) console.say(fmt::format("auto       chose {}: {}", choice->structure, choice->reason));
  console.status("building " + spec);
  const Timer timer;
  SceneAccelerator accelerator(scene, spec);
  const double seconds = timer.seconds();
  StructureStatistics statistics = accelerator.statistics();
  statistics.build_seconds = seconds;
  console.say(fmt::format("structure  {}: {}, depth {}, {}; built in {} on {}", accelerator.spec(), counted(statistics.nodes, "node"),
                          statistics.depth, byte_size(statistics.bytes), duration(seconds), counted(arena_threads(), "thread")));
  return {std::move(accelerator), std::move(statistics)};
}

void drop_shading_data(Scene& scene) {
  for (Object& object : scene.objects) {
    for (Part& part : object.parts) {
      part.normals = {};
      part.uvs = {};
      part.tangents = {};
      part.colours = {};
    }
  }
  scene.materials = {};
  scene.textures = {};
  scene.images = {};
  scene.environment = {};
}

}  // namespace grove::app
