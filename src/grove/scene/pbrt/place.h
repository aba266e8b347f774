#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "grove/base/error.h"

namespace grove::pbrt {

/// A line of a scene file, for messages. Cheap to copy.
struct Place {
  std::shared_ptr<const std::string> file;
  std::uint32_t line = 0;

  /// "file:line".
  [[nodiscard]] std::string text() const { return file_name() + ":" + std::to_string(line); }
  /// Empty for a default-made place.
  [[nodiscard]] std::string file_name() const { return file == nullptr ? std::string() : *file; }

  /// Throws InputError: "file:line: problem".
  [[noreturn]] void fail(std::string_view problem) const { throw InputError(file_name(), std::to_string(line), problem); }
};

}  // namespace grove::pbrt
