#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "grove/render/adaptive/noise.h"
#include "grove/render/film.h"
#include "grove/render/picture_part.h"
#include "grove/render/saved/picture_identity.h"

namespace grove {

/// What a film file says of the film in it.
struct FilmHeader {
  std::string scene;  ///< as it was named; for people, and not compared
  PictureIdentity picture;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples_per_pixel = 0;  ///< of the whole picture
  PicturePart part;                     ///< what of it the film is to hold when it is finished
  NoiseTarget noise;                    ///< where it is on, pixels may be finished before they hold all of that
  bool is_finished = false;
  std::uint64_t rays_traced = 0;
  double seconds = 0.0;  ///< of work, over all that went into the film
};

struct SavedFilm {
  FilmHeader header;
  Film film;  ///< of the whole picture's size; pixels outside of the part are empty
};

/// Writes a film, finished or not, in full precision. The file appears whole or not at all, and what was there before stays until the new one is on
/// the disk. 48 bytes a pixel of the part. Throws OutputError.
///
/// Layout, all little-endian: "GROVFILM"; version 2 (uint32); size of the header in bytes (uint32); the header, JSON; for each tile of the
/// part in order, for each of its pixels row by row: sums of radiance, albedo and normal (9 float32), the sum of the squared luminances
/// of the radiance (float32), samples in them and samples that were dropped (2 uint32); a 64-bit checksum (`Hash`, of the pieces: the first 16 bytes, the header, each tile).
void write_film(const FilmHeader& header, const Film& film, const std::filesystem::path& path);

/// Reads the header alone, and checks that the size of the file fits it. Throws InputError for what is not a film file or was cut off.
[[nodiscard]] FilmHeader read_film_header(const std::filesystem::path& path);

/// Reads a film. Throws InputError as read_film_header does, and for a file whose checksum or counts do not fit.
[[nodiscard]] SavedFilm read_film(const std::filesystem::path& path);

}  // namespace grove
