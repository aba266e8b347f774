#include "grove/render/adaptive/sample_rounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr std::uint32_t kLongestRound = 16;
constexpr std::size_t kTilePixels = std::size_t{TileGrid::kSide} * TileGrid::kSide;

std::uint32_t end_of_next_round(std::uint32_t taken) {
  if (taken >= kLongestRound) return taken / kLongestRound * kLongestRound + kLongestRound;
  return std::bit_ceil(taken + 1);
}

template <typename Visit>
void for_each_pixel(const Tile& tile, const Visit& visit) {
  for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y)
    for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) visit(x, y);
}

}  // namespace

SampleRounds::SampleRounds(const Film& film, const PicturePart& part, const NoiseTarget& noise)
    : film_(&film), part_(part), noise_(noise), grid_(film.width(), film.height()), goals_(std::size_t{film.width()} * film.height()) {
  noise_.min_samples = std::min(noise.min_samples, part.samples_per_pixel());
}

void SampleRounds::plan(std::uint32_t most_each) {
  const std::size_t count = part_.tile_count(grid_);
  std::vector<std::uint32_t> least(count, part_.samples_per_pixel());
  parallel_for(count, 16, [&](std::size_t i) {
    for_each_pixel(grid_.tile(part_.tile_number(i)), [&](std::uint32_t x, std::uint32_t y) {
      least[i] = std::min(least[i], static_cast<std::uint32_t>(film_->pixel(x, y).taken()));
    });
  });
  const std::uint32_t least_of_all = least.empty() ? 0 : *std::ranges::min_element(least);
  has_empty_pixels_ = least_of_all == 0;
  std::vector<TilePlan> plans(count);
  parallel_for(count, 1, [&](std::size_t i) {
    // A tile makes up its mind when all of its pixels have samples enough for that.
    const bool is_decided = noise_.is_on() && least[i] >= noise_.min_samples;
    const std::uint32_t end = is_decided ? 0 : end_of_next_round(noise_.is_on() ? least[i] : least_of_all);
    plans[i] = plan_tile(grid_.tile(part_.tile_number(i)), end, most_each);
  });
  samples_ = 0;
  pixels_ = 0;
  double left = 0.0;
  for (const TilePlan& plan : plans) {
    samples_ += plan.samples;
    pixels_ += plan.pixels;
    left += plan.samples_left;
  }
  samples_left_ = std::max(samples_, static_cast<std::uint64_t>(left));
}

SampleRounds::TilePlan SampleRounds::plan_tile(const Tile& tile, std::uint32_t end, std::uint32_t most_each) {
  const std::uint32_t most = part_.samples_per_pixel();
  const bool goes_by_noise = end == 0;
  std::array<float, kTilePixels> noise{};
  if (goes_by_noise) estimate_noise(*film_, tile, noise_.floor, noise);
  TilePlan plan;
  std::size_t i = 0;
  for_each_pixel(tile, [&](std::uint32_t x, std::uint32_t y) {
    const auto taken = static_cast<std::uint32_t>(film_->pixel(x, y).taken());
    const float excess = goes_by_noise ? noise.at(i++) / noise_.target : 2.0F;
    std::uint32_t goal = goes_by_noise ? end_of_next_round(taken) : end;
    // A NaN, of sums that overflowed, is not calm.
    if (excess <= 1.0F) goal = taken;
    goal = std::min({goal, most, most - taken > most_each ? taken + most_each : most});
    goals_[std::size_t{y} * film_->width() + x] = goal;
    const auto left = static_cast<double>(most - taken);
    if (!noise_.is_on()) plan.samples_left += left;
    if (goal <= taken) return;
    ++plan.pixels;
    plan.samples += goal - taken;
    if (!noise_.is_on()) return;
    const double wanted = static_cast<double>(excess) * static_cast<double>(excess) * taken - taken;
    plan.samples_left += goes_by_noise ? (wanted < left ? wanted : left) : static_cast<double>(goal - taken);
  });
  return plan;
}

}  // namespace grove
