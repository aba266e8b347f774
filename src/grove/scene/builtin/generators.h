#pragma once

#include "grove/scene/builtin/options.h"
#include "grove/scene/scene.h"

namespace grove {

// One function per built-in scene; README.md beside this file lists their keys and their numbers of primitives.
[[nodiscard]] Scene make_cornell(const BuiltinOptions& options);
[[nodiscard]] Scene make_gears(const BuiltinOptions& options);
[[nodiscard]] Scene make_lanterns(const BuiltinOptions& options);
[[nodiscard]] Scene make_mount(const BuiltinOptions& options);
[[nodiscard]] Scene make_rings(const BuiltinOptions& options);
[[nodiscard]] Scene make_shatter(const BuiltinOptions& options);
[[nodiscard]] Scene make_soup(const BuiltinOptions& options);
[[nodiscard]] Scene make_sphereflake(const BuiltinOptions& options);
[[nodiscard]] Scene make_spheres(const BuiltinOptions& options);
[[nodiscard]] Scene make_stadium(const BuiltinOptions& options);
[[nodiscard]] Scene make_tree(const BuiltinOptions& options);
[[nodiscard]] Scene make_twist(const BuiltinOptions& options);

}  // namespace grove
