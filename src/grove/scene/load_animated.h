#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "grove/scene/animation/animated_scene.h"

namespace grove {

/// Reads a scene as load_scene does, with one of its animations: that of the name `choice`, else of that number, counted from 0; where it is empty the
/// first. Only glTF files have any. The built-in scenes that move (moving_builtin_scenes) do so from 0 to 1 s, unless they are asked for a
/// time. Other scenes, and files without an animation, do not move. Keyframes that cannot be used are mended or left out, with
/// warnings. Throws what load_scene throws, and UsageError when the animation that was asked for is not there.
[[nodiscard]] AnimatedScene load_animated_scene(const std::string& source, const std::string& choice);

/// The same for a glTF file.
[[nodiscard]] AnimatedScene load_animated_gltf(const std::filesystem::path& file, const std::string& choice);

}  // namespace grove
