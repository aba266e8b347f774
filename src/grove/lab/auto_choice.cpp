#include "grove/lab/auto_choice.h"

#include "grove/lab/largest_object.h"

namespace grove {

std::optional<StructureChoice> auto_choice(const Scene& scene, std::string_view spec) {
  const Object* const object = largest_object(scene);
  if (object == nullptr || !canonical_spec(spec).starts_with("auto")) return std::nullopt;
  StructureChoice choice = choose_structure(geometry_of(*object), use_of(spec));
  if (scene.objects.size() > 1 || scene.instances.size() > 1)
    choice.reason = "for the largest object: " + choice.reason + "; the others and the instances are each looked at likewise";
  return choice;
}

}  // namespace grove
