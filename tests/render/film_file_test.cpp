#include "grove/render/saved/film_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "lab/temporary_directory.h"
#include "same_bits.h"

namespace grove {
namespace {

using ::testing::HasSubstr;
using testing::read_file;
using testing::TemporaryDirectory;
using testing::write_file;

FilmHeader header_of(std::uint32_t width, std::uint32_t height) {
  FilmHeader header;
  header.scene = "builtin:cornell?name=\"\xc3\xa4\n";
  header.picture.facts = {{"seed", "7"}, {"width", std::to_string(width)}, {"height", std::to_string(height)}, {"integrator", "ao"}};
  header.width = width;
  header.height = height;
  header.samples_per_pixel = 16;
  header.part = {1, 2, 4, 12};
  header.noise = {.target = 0.1F, .min_samples = 8, .floor = 0.03F};
  header.is_finished = true;
  header.rays_traced = 1ULL << 40;
  header.seconds = 0.1;
  return header;
}

// Random sums in the tiles of the part; every fourth sample is dropped.
Film film_of(const FilmHeader& header) {
  Film film(header.width, header.height);
  Random random(3);
  const TileGrid grid(header.width, header.height);
  for (std::size_t i = 0; i < header.part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(header.part.tile_number(i));
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) {
        for (std::uint32_t s = 0; s < random.next_u32(9); ++s) {
          film.add(x, y, Film::Sample{.radiance = Vec3(random.next_u32(4) == 0 ? NAN : random.next_float()), .normal = Vec3(-0.0F)});
        }
      }
    }
  }
  return film;
}

template <typename Function>
std::string error_of(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FilmFile, GivesBackWhatWasWritten) {
  const TemporaryDirectory directory;
  const auto path = directory / "a.film";
  const FilmHeader header = header_of(50, 37);
  const Film film = film_of(header);
  EXPECT_GT(film.dropped_samples(), 0U);
  write_film(header, film, path);
  const SavedFilm saved = read_film(path);
  EXPECT_TRUE(testing::same_bits(film, saved.film));
  EXPECT_EQ(saved.header.scene, header.scene);
  EXPECT_EQ(saved.header.width, header.width);
  EXPECT_EQ(saved.header.height, header.height);
  EXPECT_EQ(saved.header.samples_per_pixel, header.samples_per_pixel);
  EXPECT_EQ(saved.header.part.text(), header.part.text());
  EXPECT_EQ(saved.header.noise, header.noise);
  EXPECT_EQ(saved.header.is_finished, header.is_finished);
  EXPECT_EQ(saved.header.rays_traced, header.rays_traced);
  EXPECT_EQ(saved.header.seconds, header.seconds);
  EXPECT_EQ(difference(saved.header.picture, header.picture), "");
  EXPECT_EQ(read_film_header(path).rays_traced, header.rays_traced);
  EXPECT_EQ(directory.entry_count(), 1U) << "a temporary file is left";
}

TEST(FilmFile, EveryCutIsNoticed) {
  const TemporaryDirectory directory;
  const FilmHeader header = header_of(18, 1);  // the part is the two pixels at the right
  write_film(header, film_of(header), directory / "a.film");
  const std::string bytes = read_file(directory / "a.film");
  ASSERT_GT(bytes.size(), 200U);
  const auto cut = directory / "cut.film";
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    write_file(cut, bytes.substr(0, size));
    EXPECT_THAT(error_of([&] { (void)read_film(cut); }), HasSubstr("cut.film: ")) << size;
  }
  write_file(cut, bytes + "x");
  EXPECT_THAT(error_of([&] { (void)read_film(cut); }), HasSubstr("cut off or added to"));
}

TEST(FilmFile, EveryChangedByteIsNoticed) {
  const TemporaryDirectory directory;
  const FilmHeader header = header_of(18, 1);
  write_film(header, film_of(header), directory / "a.film");
  const std::string bytes = read_file(directory / "a.film");
  const auto changed = directory / "changed.film";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char mask : {'\x01', '\x80'}) {
      std::string other = bytes;
      other[i] = static_cast<char>(other[i] ^ mask);
      write_file(changed, other);
      EXPECT_THAT(error_of([&] { (void)read_film(changed); }), HasSubstr("changed.film")) << i;
    }
  }
}

TEST(FilmFile, OtherFilesAreRefusedInAWord) {
  const TemporaryDirectory directory;
  const auto message = [&](std::string_view bytes) {
    write_file(directory / "a.film", bytes);
    return error_of([&] { (void)read_film_header(directory / "a.film"); });
  };
  EXPECT_THAT(message(""), HasSubstr("too short"));
  EXPECT_THAT(message(std::string(100, 'x')), HasSubstr("GROVFILM"));
  EXPECT_THAT(message(std::string("GROVFILM\x01\0\0\0\0\0\0\0", 16) + std::string(100, ' ')), HasSubstr("version 1"));
  EXPECT_THAT(message(std::string("GROVFILM\x02\0\0\0\xff\xff\0\0", 16) + std::string(100, ' ')), HasSubstr("header"));
  EXPECT_THAT(message(std::string("GROVFILM\x02\0\0\0\x02\0\0\0{}", 18) + std::string(100, ' ')), HasSubstr("scene"));
  EXPECT_THAT(error_of([&] { (void)read_film(directory.path()); }), HasSubstr("no regular file"));
  EXPECT_THAT(error_of([&] { (void)read_film(directory / "missing.film"); }), HasSubstr("No such file"));
}

TEST(FilmFile, PicturesThatCannotBeAreRefused) {
  const TemporaryDirectory directory;
  const auto path = directory / "a.film";
  const auto message = [&](auto change) {
    FilmHeader header = header_of(18, 1);
    const Film film = film_of(header);
    change(header);
    write_film(header, film, path);
    return error_of([&] { (void)read_film(path); });
  };
  EXPECT_EQ(message([](FilmHeader& /*header*/) {}), "no error");
  EXPECT_THAT(message([](FilmHeader& header) { header.part.end_sample = 17; }), HasSubstr("no part of the picture"));
  EXPECT_THAT(message([](FilmHeader& header) { header.part.first_sample = 12; }), HasSubstr("no part of the picture"));
  EXPECT_THAT(message([](FilmHeader& header) { header.part.end_sample = 5; }), HasSubstr("more samples than there are"));
  EXPECT_THAT(message([](FilmHeader& header) { header.noise.floor = -1.0F; }), HasSubstr("noise target"));
  EXPECT_THAT(message([](FilmHeader& header) { header.picture.facts[1].value = "19"; }), HasSubstr("two sizes"));
  EXPECT_THAT(message([](FilmHeader& header) { header.picture.facts[3].value = "magic"; }), HasSubstr("unknown integrator"));
}

}  // namespace
}  // namespace grove
