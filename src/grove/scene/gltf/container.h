#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace grove {

/// The two parts of a glTF file.
struct GltfContainer {
  std::string_view json;
  /// Only a .glb has one, and not each.
  std::optional<std::span<const std::byte>> binary;
};

/// Finds the parts of a .gltf or .glb (told from the content); they refer to `data`. Throws InputError naming `file` when a length in
/// a header disagrees with the file.
[[nodiscard]] GltfContainer split_container(std::span<const std::byte> data, const std::string& file);

}  // namespace grove
