#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "grove/scene/pbrt/place.h"

namespace grove::pbrt {

/// Warnings in the order first met, one for each text; the place is that of the first.
class Warnings {
 public:
  /// Keeps "file:line: text" unless `text` was there before.
  void add(const Place& place, std::string_view text);
  /// Adds those of `other` that are new.
  void merge(const Warnings& other);

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::set<std::string, std::less<>> seen_;
  std::vector<std::string> texts_;
  std::vector<std::string> lines_;
};

/// Where file names that a scene mentions are looked for: as they are when absolute, else from the directory of the main scene file.
[[nodiscard]] std::filesystem::path resolve_file(const std::filesystem::path& directory, std::string_view name);

/// What builders of one thread share.
struct Context {
  std::filesystem::path directory;
  Warnings& warnings;
  /// Steps around a tessellated quadric; half as many from pole to pole.
  std::uint32_t quadric_steps = 64;
};

}  // namespace grove::pbrt
