#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "grove/base/error.h"
#include "grove/scene/builtin/generators.h"
#include "grove/scene/builtin/options.h"
#include "grove/scene/formats/text.h"
#include "grove/scene/load.h"

namespace grove {
namespace {

struct Generator {
  std::string_view name;
  Scene (*make)(const BuiltinOptions&);
  bool moves = false;  // has the key `time`
};

constexpr std::array<Generator, 12> kGenerators{{{"cornell", make_cornell},
                                                 {"gears", make_gears},
                                                 {"lanterns", make_lanterns},
                                                 {"mount", make_mount},
                                                 {"rings", make_rings},
                                                 {"shatter", make_shatter, true},
                                                 {"soup", make_soup},
                                                 {"sphereflake", make_sphereflake},
                                                 {"spheres", make_spheres},
                                                 {"stadium", make_stadium},
                                                 {"tree", make_tree},
                                                 {"twist", make_twist, true}}};

}  // namespace

std::vector<std::string> moving_builtin_scenes() {
  std::vector<std::string> names;
  for (const Generator& generator : kGenerators)
    if (generator.moves) names.emplace_back(generator.name);
  return names;
}

Scene make_builtin_scene(std::string_view request) {
  const BuiltinOptions options(request);
  const auto found = std::find_if(kGenerators.begin(), kGenerators.end(), [&](const Generator& g) { return g.name == options.name(); });
  if (found == kGenerators.end()) {
    std::string known;
    for (const Generator& generator : kGenerators) known += (known.empty() ? "" : ", ") + std::string(generator.name);
    throw UsageError("unknown built-in scene " + quote(options.name()) + "; allowed are " + known);
  }
  Scene scene = found->make(options);
  scene.name = "builtin:" + std::string(request);
  return scene;
}

}  // namespace grove
