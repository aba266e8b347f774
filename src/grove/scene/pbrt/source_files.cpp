#include "grove/scene/pbrt/source_files.h"

#include <algorithm>
#include <cstddef>
#include <system_error>
#include <utility>

#include "grove/scene/read_file.h"

namespace grove::pbrt {
namespace {

constexpr std::size_t kMaxDepth = 64;
// Text that is read a second time or more; without a limit, 30 small files that each include the next one twice would never end.
constexpr std::uint64_t kMaxRepeatedBytes = 256U << 20;
// An included file that is empty has no bytes to count, but costs time.
constexpr std::uint64_t kCostOfOpening = 8192;

std::string canonical_name(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(file, error);
  return error ? file.string() : canonical.string();
}

}  // namespace

std::unique_ptr<Tokenizer> SourceFiles::open(const std::filesystem::path& file, const Place& place) {
  const std::string name = canonical_name(file);
  if (std::find(stack_.begin(), stack_.end(), name) != stack_.end())
    place.fail("\"" + file.filename().string() + "\" includes itself; remove the circle of Include directives");
  if (stack_.size() >= kMaxDepth) place.fail("includes are nested more than " + std::to_string(kMaxDepth) + " deep");

  std::error_code error;
  if (place.line > 0 && !std::filesystem::is_regular_file(file, error)) place.fail("the file \"" + file.string() + "\" is not there");
  const std::vector<std::byte> bytes = grove::read_file(file);
  if (times_[name]++ > 0) repeated_bytes_ += bytes.size() + kCostOfOpening;
  if (repeated_bytes_ > kMaxRepeatedBytes) place.fail("files are included again and again; use ObjectBegin and ObjectInstance");
  if (bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b})
    throw InputError(file.string(), "", "gzip-compressed scene text is not read; unpack it with gunzip");

  stack_.push_back(name);
  return std::make_unique<Tokenizer>(std::make_shared<std::string>(file.string()),
                                     std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace grove::pbrt
