#include "picture_part_options.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "grove/base/error.h"

namespace grove::app {
namespace {

struct NumberPair {
  std::uint32_t first;
  std::uint32_t second;
};

std::optional<NumberPair> parse_pair(const std::string& text, char separator) {
  NumberPair pair{};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, pair.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != separator) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, pair.second);
  if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
  return pair;
}

}  // namespace

void parse_tile(const std::string& text, PicturePart& part) {
  const std::optional<NumberPair> pair = parse_pair(text, '/');
  if (!pair || pair->first < 1 || pair->first > pair->second) {
    throw UsageError(fmt::format("--tile: '{}' is no share i/N; four shares are 1/4, 2/4, 3/4 and 4/4", text));
  }
  part.share = pair->first - 1;
  part.share_count = pair->second;
}

void parse_samples(const std::string& text, std::uint32_t samples_per_pixel, PicturePart& part) {
  const std::optional<NumberPair> pair = parse_pair(text, ':');
  if (!pair || pair->first >= pair->second || pair->second > samples_per_pixel) {
    throw UsageError(fmt::format("--samples: '{}' is no range a:b within the samples of each pixel, which --spp says are 0:{}", text,
                                 samples_per_pixel));
  }
  part.first_sample = pair->first;
  part.end_sample = pair->second;
}

}  // namespace grove::app
