#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "grove/base/error.h"
#include "grove/base/random.h"

namespace grove {

/// A file with this content, of this name, in a folder of its own; gone with the object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, std::string_view content) {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() / ("grove-scene-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / name;
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Gives it other content.
  void rewrite(std::string_view content) const { std::ofstream(path_, std::ios::binary) << content; }
  /// Writes another file beside it.
  void add(const std::string& name, std::string_view content) const { std::ofstream(folder_ / name, std::ios::binary) << content; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path path_;
};

/// The shared scenes, beside the repository.
inline std::filesystem::path shared_scene(const std::string& name) {
  return std::filesystem::path(GROVE_SOURCE_DIR) / ".." / "shared" / "scenes" / name;
}

/// The message of the InputError that `run` throws; fails the test when it throws none.
template <typename Run>
std::string input_error_of(const Run& run) {
  try {
    run();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "more than one line";
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

/// `content` with a few bytes changed, put in, cut out or cut off: the same for the same seed.
inline std::string mutated(std::string content, std::uint64_t seed) {
  Random random(seed);
  constexpr std::string_view interesting = "0-/ \n9.e#\xff\x7f";
  const std::uint32_t changes = 1 + random.next_u32(4);
  for (std::uint32_t i = 0; i < changes && !content.empty(); ++i) {
    const std::size_t at = random.next_u32(static_cast<std::uint32_t>(content.size()));
    const char byte = random.next_u32(2) == 0 ? interesting[random.next_u32(interesting.size())] : static_cast<char>(random.next_u32(256));
    switch (random.next_u32(5)) {
      case 0:
        content[at] = byte;
        break;
      case 1:
        content.insert(at, 1, byte);
        break;
      case 2:
        content.erase(at, 1 + random.next_u32(8));
        break;
      case 3:
        content.insert(at, content.substr(at, 1 + random.next_u32(16)));
        break;
      default:
        content[at] = static_cast<char>(content[at] ^ (1 << random.next_u32(8)));
        if (random.next_u32(4) == 0) content.resize(at);
        break;
    }
  }
  return content;
}

}  // namespace grove
