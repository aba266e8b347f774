#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grove/scene/pbrt/tokenizer.h"

namespace grove::pbrt {

/// The scene file and its includes, as a stack. Refuses what would never end or grow beyond all measure: a file inside itself, includes
/// nested too deep, and files included again and again until their text adds up to too much.
class SourceFiles {
 public:
  /// Opens a file that `place` asks for (the main file: any place with line 0). Throws InputError when it cannot be read or is refused.
  std::unique_ptr<Tokenizer> open(const std::filesystem::path& file, const Place& place);
  /// To be called when a file is read to its end.
  void close() { stack_.pop_back(); }

 private:
  std::vector<std::string> stack_;              // canonical names of the files being read
  std::map<std::string, std::uint64_t> times_;  // how often each was opened
  std::uint64_t repeated_bytes_ = 0;
};

}  // namespace grove::pbrt
