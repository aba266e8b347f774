#include "grove/render/saved/merge_films.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "grove/base/error.h"

namespace grove {
namespace {

struct Source {
  std::filesystem::path path;
  FilmHeader header;
};

/// In the order in which they are added.
std::vector<Source> read_headers(std::span<const std::filesystem::path> files) {
  std::vector<Source> sources;
  sources.reserve(files.size());
  for (const std::filesystem::path& path : files) sources.push_back({path, read_film_header(path)});
  std::ranges::stable_sort(sources, {}, [](const Source& source) {
    const PicturePart& part = source.header.part;
    return std::tuple(part.first_sample, part.share_count, part.share);
  });
  return sources;
}

void check_same_picture(const Source& first, const Source& other) {
  std::string different = difference(other.header.picture, first.header.picture);
  if (different.empty() && other.header.samples_per_pixel != first.header.samples_per_pixel) {
    different =
        std::to_string(other.header.samples_per_pixel) + " samples per pixel instead of " + std::to_string(first.header.samples_per_pixel);
  }
  if (different.empty() && other.header.noise != first.header.noise) different = "noise settings differ";
  if (!different.empty()) {
    throw InputError(other.path.string() + ": is of another picture than " + first.path.string() + ": " + different);
  }
}

void check_apart(const Source& a, const Source& b, const TileGrid& grid) {
  const PicturePart& one = a.header.part;
  const PicturePart& other = b.header.part;
  if (one.end_sample <= other.first_sample || other.end_sample <= one.first_sample) return;
  for (std::size_t i = 0; i < one.tile_count(grid); ++i) {
    if (!other.has_tile(one.tile_number(i))) continue;
    throw InputError(a.path.string() + " (" + one.text() + ") and " + b.path.string() + " (" + other.text() +
                     ") hold the same samples; leave one of them out");
  }
}

/// The least number of shares into which each part falls evenly, or one share for each tile.
std::uint32_t common_share_count(std::span<const Source> sources, const TileGrid& grid) {
  std::uint64_t count = 1;
  for (const Source& source : sources) {
    count = std::lcm(count, std::uint64_t{source.header.part.share_count});
    if (count >= grid.count()) return static_cast<std::uint32_t>(grid.count());
  }
  return static_cast<std::uint32_t>(count);
}

/// The parts that would complete the picture.
std::vector<PicturePart> gaps(std::span<const Source> sources, const TileGrid& grid) {
  const std::uint32_t shares = common_share_count(sources, grid);
  const std::uint32_t samples = sources.front().header.samples_per_pixel;
  std::vector<PicturePart> found;
  for (std::uint32_t share = 0; share < shares; ++share) {
    std::uint32_t covered = 0;
    const auto close_gap = [&](std::uint32_t end) {
      if (covered < end) found.push_back({share, shares, covered, end});
    };
    for (const Source& source : sources) {
      const PicturePart& part = source.header.part;
      if (!part.has_tile(share)) continue;
      close_gap(part.first_sample);
      covered = std::max(covered, part.end_sample);
    }
    close_gap(samples);
  }
  return found;
}

void append_clause(std::string& text, const std::string& clause) {
  text += (text.empty() ? "" : "; ") + clause;
}

std::string list_gaps(const std::vector<PicturePart>& parts) {
  constexpr std::size_t kMostNamed = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(parts.size(), kMostNamed); ++i) text += (i == 0 ? "" : ", ") + parts.at(i).text();
  if (parts.size() > kMostNamed) text += " and " + std::to_string(parts.size() - kMostNamed) + " more";
  return text;
}

/// Adds the film to `whole`. Returns the share of its samples that it has.
double add_film(const SavedFilm& saved, const TileGrid& grid, Film& whole) {
  const PicturePart& part = saved.header.part;
  std::uint64_t taken = 0;
  for (std::size_t i = 0; i < part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(part.tile_number(i));
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        whole.add(x, y, saved.film.pixel(x, y));
        taken += saved.film.pixel(x, y).taken();
      }
    }
  }
  return static_cast<double>(taken) / (static_cast<double>(part.pixel_count(grid)) * part.samples_per_pixel());
}

}  // namespace

MergedFilm merge_films(std::span<const std::filesystem::path> files) {
  if (files.empty()) throw UsageError("there are no films to merge");
  const std::vector<Source> sources = read_headers(files);
  const FilmHeader& first = sources.front().header;
  const TileGrid grid(first.width, first.height);
  for (auto source = sources.begin() + 1; source != sources.end(); ++source) check_same_picture(sources.front(), *source);
  for (auto a = sources.begin(); a != sources.end(); ++a)
    for (auto b = a + 1; b != sources.end(); ++b) check_apart(*a, *b, grid);

  MergedFilm merged{{first, Film(first.width, first.height)}, {}};
  FilmHeader& header = merged.whole.header;
  header.part = {0, 1, 0, first.samples_per_pixel};
  header.rays_traced = 0;
  header.seconds = 0.0;
  if (const std::vector<PicturePart> missing = gaps(sources, grid); !missing.empty()) {
    append_clause(merged.missing, "no part holds " + list_gaps(missing));
  }
  for (const Source& source : sources) {
    const SavedFilm saved = read_film(source.path);
    header.rays_traced += saved.header.rays_traced;
    header.seconds += saved.header.seconds;
    const bool is_full = add_film(saved, grid, merged.whole.film) >= 1.0;
    // With a noise target a finished film need not be full.
    if (!is_full && !(saved.header.noise.is_on() && saved.header.is_finished))
      append_clause(merged.missing, source.path.string() + " is unfinished");
  }
  header.is_finished = merged.missing.empty();
  return merged;
}

}  // namespace grove
