#include "grove/render/picture_part.h"

namespace grove {

std::uint64_t PicturePart::pixel_count(const TileGrid& grid) const {
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < tile_count(grid); ++i) pixels += grid.tile(tile_number(i)).pixel_count();
  return pixels;
}

std::string PicturePart::text() const {
  std::string text;
  if (share_count > 1) text += "--tile " + std::to_string(share + 1) + "/" + std::to_string(share_count) + " ";
  return text + "--samples " + std::to_string(first_sample) + ":" + std::to_string(end_sample);
}

}  // namespace grove
