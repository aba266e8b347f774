#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// Reads the scene that `source` names: a file (.gltf .glb .obj .ply .ply.gz .stl .pbrt) or `builtin:NAME?key=value&key=value`.
/// The result is validated. Throws InputError when the file cannot be used, UsageError for an unknown built-in name or key.
/// Memory stays within a small multiple of the file's size (for built-in scenes: of the geometry made).
[[nodiscard]] Scene load_scene(const std::string& source);

// One reader per format; each throws InputError naming the file and the place. None prints.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& file);
[[nodiscard]] Scene load_pbrt(const std::filesystem::path& file);
[[nodiscard]] Scene load_obj(const std::filesystem::path& file);
[[nodiscard]] Scene load_ply(const std::filesystem::path& file);
[[nodiscard]] Scene load_stl(const std::filesystem::path& file);
/// `request` is what follows "builtin:".
[[nodiscard]] Scene make_builtin_scene(std::string_view request);
/// The built-in scenes that move: they have a key `time` from 0 to 1, at all values of which they have the same primitives.
[[nodiscard]] std::vector<std::string> moving_builtin_scenes();

}  // namespace grove
