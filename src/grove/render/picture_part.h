#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace grove {

/// Pixels with first_x <= x < end_x and first_y <= y < end_y.
struct Tile {
  std::uint32_t first_x = 0;
  std::uint32_t first_y = 0;
  std::uint32_t end_x = 0;
  std::uint32_t end_y = 0;

  [[nodiscard]] std::uint32_t pixel_count() const { return (end_x - first_x) * (end_y - first_y); }
};

/// A picture cut into squares of pixels, numbered row by row from the upper left; those at the right and lower edge may be smaller.
class TileGrid {
 public:
  static constexpr std::uint32_t kSide = 16;
  static constexpr std::uint32_t kMaxSide = 1U << 16;
  static constexpr std::uint64_t kMaxPixels = 1ULL << 28;

  /// Whether a picture of this size can be made.
  [[nodiscard]] static bool is_possible(std::uint32_t width, std::uint32_t height) {
    return width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide && std::uint64_t{width} * height <= kMaxPixels;
  }

  TileGrid(std::uint32_t width, std::uint32_t height) : width_(width), height_(height), across_((width + kSide - 1) / kSide) {}

  [[nodiscard]] std::size_t count() const { return std::size_t{across_} * ((height_ + kSide - 1) / kSide); }
  [[nodiscard]] Tile tile(std::size_t number) const {
    const auto x = static_cast<std::uint32_t>(number % across_) * kSide;
    const auto y = static_cast<std::uint32_t>(number / across_) * kSide;
    return {x, y, std::min(width_, x + kSide), std::min(height_, y + kSide)};
  }

 private:
  std::uint32_t width_;
  std::uint32_t height_;
  std::uint32_t across_;
};

/// The part of a picture that one render makes: which tiles, and which samples of each pixel. Tiles are dealt out in turn, tile t to share
/// t % share_count, so that shares take about equally long wherever in the picture the work is.
struct PicturePart {
  std::uint32_t share = 0;  ///< below share_count
  std::uint32_t share_count = 1;
  std::uint32_t first_sample = 0;
  std::uint32_t end_sample = 0;  ///< one behind the last

  [[nodiscard]] bool has_tile(std::size_t tile) const { return tile % share_count == share; }
  /// How many tiles, and the tile number of one of them.
  [[nodiscard]] std::size_t tile_count(const TileGrid& grid) const {
    return grid.count() <= share ? 0 : (grid.count() - share - 1) / share_count + 1;
  }
  [[nodiscard]] std::size_t tile_number(std::size_t i) const { return share + i * share_count; }
  [[nodiscard]] std::uint64_t pixel_count(const TileGrid& grid) const;
  [[nodiscard]] std::uint32_t samples_per_pixel() const { return end_sample - first_sample; }
  [[nodiscard]] bool is_whole(std::uint32_t samples_of_picture) const {
    return share_count == 1 && first_sample == 0 && end_sample == samples_of_picture;
  }
  /// The options of the command that name it, such as "--tile 2/4 --samples 0:16"; a share of one share is left out.
  [[nodiscard]] std::string text() const;
};

}  // namespace grove
