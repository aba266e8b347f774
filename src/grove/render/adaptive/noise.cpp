#include "grove/render/adaptive/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr std::uint32_t kReach = 2;
constexpr std::size_t kTilePixels = std::size_t{TileGrid::kSide} * TileGrid::kSide;

// Of one pixel or of several together.
struct Moments {
  double luminance = 0.0;   // sum over samples
  double deviations = 0.0;  // squared, from the pixels' own means
  double samples = 0.0;
  double freedom = 0.0;  // samples that variance can be told from

  void add(const Film::Pixel& pixel) {
    if (pixel.sample_count < 2) return;
    const auto count = static_cast<double>(pixel.sample_count);
    luminance += static_cast<double>(pixel.mean_luminance()) * count;
    deviations += static_cast<double>(pixel.squared_deviations());
    samples += count;
    freedom += count - 1.0;
  }

  /// For a pixel of `count` samples.
  [[nodiscard]] double relative_error(double count, double floor) const {
    return std::sqrt(deviations / (freedom * count)) / std::max(luminance / samples, floor);
  }
};

}  // namespace

void estimate_noise(const Film& film, const Tile& tile, float floor, std::span<float> noise) {
  std::size_t i = 0;
  for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
    for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x, ++i) {
      const Film::Pixel& pixel = film.pixel(x, y);
      if (pixel.sample_count < 2) {
        noise[i] = std::numeric_limits<float>::infinity();
        continue;
      }
      Moments own;
      own.add(pixel);
      Moments pooled;
      for (std::uint32_t ny = std::max(tile.first_y + kReach, y) - kReach; ny < std::min(tile.end_y, y + kReach + 1); ++ny)
        for (std::uint32_t nx = std::max(tile.first_x + kReach, x) - kReach; nx < std::min(tile.end_x, x + kReach + 1); ++nx)
          pooled.add(film.pixel(nx, ny));
      const auto count = static_cast<double>(pixel.sample_count);
      const auto least = static_cast<double>(floor);
      noise[i] = static_cast<float>(std::max(own.relative_error(count, least), pooled.relative_error(count, least)));
    }
  }
}

NoiseSummary summarize_noise(const Film& film, const PicturePart& part, const NoiseTarget& target) {
  const TileGrid grid(film.width(), film.height());
  struct Sums {
    double squares = 0.0;
    std::uint64_t taken = 0;
    std::uint64_t estimated = 0;
    std::uint64_t within = 0;
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t most = 0;
  };
  std::vector<Sums> tiles(part.tile_count(grid));
  parallel_for(tiles.size(), 1, [&](std::size_t i) {
    const Tile tile = grid.tile(part.tile_number(i));
    std::array<float, kTilePixels> noise{};
    estimate_noise(film, tile, target.floor, noise);
    Sums& sums = tiles[i];
    std::size_t place = 0;
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x, ++place) {
        const std::uint64_t taken = film.pixel(x, y).taken();
        sums.taken += taken;
        sums.least = std::min(sums.least, taken);
        sums.most = std::max(sums.most, taken);
        const float value = noise.at(place);
        if (value <= target.target) ++sums.within;
        if (!std::isfinite(value)) continue;
        ++sums.estimated;
        sums.squares += static_cast<double>(value) * static_cast<double>(value);
      }
    }
  });
  Sums all;
  for (const Sums& sums : tiles) {
    all.squares += sums.squares;
    all.taken += sums.taken;
    all.estimated += sums.estimated;
    all.within += sums.within;
    all.least = std::min(all.least, sums.least);
    all.most = std::max(all.most, sums.most);
  }
  const auto pixels = static_cast<double>(part.pixel_count(grid));
  NoiseSummary summary;
  summary.least_samples = tiles.empty() ? 0 : static_cast<std::uint32_t>(all.least);
  summary.most_samples = static_cast<std::uint32_t>(all.most);
  summary.mean_samples = pixels > 0.0 ? static_cast<double>(all.taken) / pixels : 0.0;
  summary.root_mean_square = std::sqrt(all.squares / static_cast<double>(all.estimated));
  summary.share_within = pixels > 0.0 ? static_cast<double>(all.within) / pixels : 0.0;
  return summary;
}

}  // namespace grove
