#pragma once

#include <optional>
#include <string_view>

#include "grove/registry/choose_structure.h"
#include "grove/scene/scene.h"

namespace grove {

/// What a spec of the family `auto` chooses for the object with most primitives, and why; the other objects and the instances of a scene are looked at likewise, each by
/// itself. Nothing for specs of other families and for a scene without objects. Throws UsageError for a bad spec.
[[nodiscard]] std::optional<StructureChoice> auto_choice(const Scene& scene, std::string_view spec);

}  // namespace grove
