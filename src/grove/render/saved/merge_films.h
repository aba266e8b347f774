#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "grove/render/saved/film_file.h"

namespace grove {

/// Parts of a picture put together.
struct MergedFilm {
  SavedFilm whole;
  /// What of the picture is in none of the parts, or in one that is unfinished: one line for a person; empty when the picture is complete.
  std::string missing;
};

/// Adds up films of one picture. Sums are formed in the order of the sample numbers, whatever the order of `files`: so merged tiles are, bit for bit, the picture
/// that one render makes, and ranges of samples always give the same bits (which differ from those of one render by rounding, because
/// each range was rounded for itself). Holds two films in memory. Throws InputError, naming the files, when they
/// are of different pictures or hold the same samples, and as read_film does; UsageError when there are none.
[[nodiscard]] MergedFilm merge_films(std::span<const std::filesystem::path> files);

}  // namespace grove
