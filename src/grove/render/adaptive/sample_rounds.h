#pragma once

#include <cstdint>
#include <vector>

#include "grove/render/adaptive/noise.h"
#include "grove/render/film.h"
#include "grove/render/picture_part.h"

namespace grove {

/// The rounds in which the pixels of a part get their samples: each takes a pixel to one of 1, 2, 4, 8, 16, 32, 48, … samples. The first numbers are those at
/// which the sample points are spread most evenly, and rounds of 16 are long enough to cost nothing. Without a noise target all pixels go through the same
/// rounds. With one, a round leaves out the pixels that are done; what is done follows from nothing but the samples that the pixel's tile holds when the round
/// begins, so that a render that was interrupted between rounds goes on as if it had not been.
class SampleRounds {
 public:
  /// The film must outlive it.
  SampleRounds(const Film& film, const PicturePart& part, const NoiseTarget& noise);

  /// Decides on the next round, as of what the film holds now, in which no pixel takes more than `most_each` >= 1 samples. Parallel in the caller's
  /// oneTBB arena.
  void plan(std::uint32_t most_each);

  /// Of the round that was planned: how many samples it takes, 0 when there is nothing left to do, and of how many pixels.
  [[nodiscard]] std::uint64_t samples() const { return samples_; }
  [[nodiscard]] std::uint64_t pixels() const { return pixels_; }
  /// Some pixel had no sample before it.
  [[nodiscard]] bool has_empty_pixels() const { return has_empty_pixels_; }
  /// How many samples pixel (x, y) is to have after it; no more than it has where the pixel is not in the round.
  [[nodiscard]] std::uint32_t goal(std::uint32_t x, std::uint32_t y) const { return goals_[std::size_t{y} * film_->width() + x]; }
  /// Samples that are left to take from the beginning of the round on: with a noise target a guess, by the noise falling with the root of their number.
  [[nodiscard]] std::uint64_t samples_left() const { return samples_left_; }

 private:
  struct TilePlan {
    std::uint64_t samples = 0;
    std::uint64_t pixels = 0;
    double samples_left = 0.0;
  };
  TilePlan plan_tile(const Tile& tile, std::uint32_t end, std::uint32_t most_each);

  const Film* film_;
  PicturePart part_;
  NoiseTarget noise_;
  TileGrid grid_;
  std::vector<std::uint32_t> goals_;
  bool has_empty_pixels_ = false;
  std::uint64_t samples_ = 0;
  std::uint64_t pixels_ = 0;
  std::uint64_t samples_left_ = 0;
};

}  // namespace grove
