#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace grove {

/// A picture read from a file: row 0 is the top. Either 8-bit (textures) or 32-bit float (environments), never both.
/// 8-bit pixels stay as they are in the file; a texture says how to decode them.
struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;       ///< 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA
  std::vector<std::uint8_t> bytes;  ///< width * height * channels, or empty
  std::vector<float> floats;        ///< width * height * channels, linear, or empty

  [[nodiscard]] bool is_float() const { return !floats.empty(); }
  [[nodiscard]] std::size_t memory() const { return bytes.size() + floats.size() * sizeof(float); }
};

}  // namespace grove
