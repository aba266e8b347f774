#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "console.h"
#include "grove/render/compare/picture_difference.h"
#include "grove/render/image/write_png.h"

namespace grove::app {

/// A picture to compare with what was made.
class ReferencePicture {
 public:
  void add_option(CLI::App& verb);

  /// That of one frame of a sequence: the number takes its place in the name, where there is one.
  [[nodiscard]] ReferencePicture of_frame(std::uint32_t number) const;

  /// Whether the name has a place for the number of a frame. Throws UsageError for one that has others.
  [[nodiscard]] bool differs_by_frame() const;

  [[nodiscard]] bool is_named() const { return !file_.empty(); }

  /// Reads it, where one was named, before any work is done in vain. Throws InputError as `read_reference` does.
  void read(std::uint32_t width, std::uint32_t height);

  /// Compares, where one was named, and says what came of it.
  void compare(const ColourImage& picture, const DisplaySettings& display, const Console& console);

  /// What came of it in a line; empty where there was nothing to compare with.
  [[nodiscard]] std::string text() const;
  /// What came of it as `reference`, `rmse` and so on; null where there was nothing to compare with.
  [[nodiscard]] nlohmann::ordered_json figures() const;

 private:
  std::filesystem::path file_;
  std::optional<ColourImage> image_;
  std::optional<PictureDifference> difference_;
};

}  // namespace grove::app
