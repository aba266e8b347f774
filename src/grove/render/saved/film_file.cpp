#include "grove/render/saved/film_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/hash.h"
#include "grove/base/output_file.h"
#include "grove/render/saved/film_header_json.h"

namespace grove {
namespace {

static_assert(std::endian::native == std::endian::little, "film files are little-endian");
static_assert(sizeof(Film::Pixel) == 48, "pixels are written as they are in memory");

constexpr std::uint32_t kVersion = 2;  // 1: without squares and noise
constexpr std::uint32_t kLargestHeader = 1U << 20;

struct Preamble {
  std::array<char, 8> magic{'G', 'R', 'O', 'V', 'F', 'I', 'L', 'M'};
  std::uint32_t version = kVersion;
  std::uint32_t header_size = 0;
};
static_assert(sizeof(Preamble) == 16);

// Reads a film file from front to back, hashing on the way.
class FilmReader {
 public:
  explicit FilmReader(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {
    if (!file_) throw InputError(name_ + ": cannot be opened (" + std::generic_category().message(errno) + ")");
    std::error_code error;
    const std::uintmax_t size = std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
    Preamble preamble;
    if (size < sizeof preamble + sizeof(std::uint64_t)) fail("is no film file: it is too short, or no regular file");
    read(&preamble, sizeof preamble);
    if (preamble.magic != Preamble().magic) fail("is no film file: it does not begin with GROVFILM");
    if (preamble.version != kVersion) {
      fail("is a film file of version " + std::to_string(preamble.version) + "; this program reads version " + std::to_string(kVersion) +
           "; render it again");
    }
    if (preamble.header_size > kLargestHeader || preamble.header_size > size) fail("is damaged: its header cannot be of the size it names");
    std::string json(preamble.header_size, '\0');
    read(json.data(), json.size());
    header_ = film_header_from_json(json, name_);
    const std::uint64_t pixels = header_.part.pixel_count(TileGrid(header_.width, header_.height));
    const std::uint64_t expected = sizeof preamble + json.size() + pixels * sizeof(Film::Pixel) + sizeof(std::uint64_t);
    if (size != expected) {
      fail("has " + std::to_string(size) + " bytes where its header tells of " + std::to_string(expected) + ": it was cut off or added to");
    }
  }

  [[nodiscard]] const FilmHeader& header() const { return header_; }

  void read_pixels(std::vector<Film::Pixel>& pixels) { read(pixels.data(), pixels.size() * sizeof(Film::Pixel)); }

  /// To be called when all pixels are read.
  void check_checksum() {
    const std::uint64_t expected = hash_.value();
    std::uint64_t found = 0;
    read(&found, sizeof found);
    if (found != expected) fail("is damaged: its checksum does not fit what it holds");
  }

  [[noreturn]] void fail(const std::string& problem) const { throw InputError(name_ + ": " + problem); }

 private:
  void read(void* bytes, std::size_t size) {
    if (!file_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size))) fail("cannot be read to its end");
    hash_.add_bytes(bytes, size);
  }

  std::string name_;
  std::ifstream file_;
  Hash hash_;
  FilmHeader header_;
};

}  // namespace

void write_film(const FilmHeader& header, const Film& film, const std::filesystem::path& path) {
  OutputFile file(path);
  Hash hash;
  const auto write = [&](const void* bytes, std::size_t size) {
    file.write(bytes, size);
    hash.add_bytes(bytes, size);
  };
  const std::string json = film_header_json(header);
  Preamble preamble;
  preamble.header_size = static_cast<std::uint32_t>(json.size());
  if (json.size() > kLargestHeader) throw OutputError(path.string() + ": the name of the scene is too long for a film file");
  write(&preamble, sizeof preamble);
  write(json.data(), json.size());
  const TileGrid grid(header.width, header.height);
  std::vector<Film::Pixel> pixels;
  pixels.reserve(std::size_t{TileGrid::kSide} * TileGrid::kSide);
  for (std::size_t i = 0; i < header.part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(header.part.tile_number(i));
    pixels.clear();
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y)
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x) pixels.push_back(film.pixel(x, y));
    write(pixels.data(), pixels.size() * sizeof(Film::Pixel));
  }
  const std::uint64_t checksum = hash.value();
  file.write(&checksum, sizeof checksum);
  file.sync();
  file.commit();
}

FilmHeader read_film_header(const std::filesystem::path& path) {
  return FilmReader(path).header();
}

SavedFilm read_film(const std::filesystem::path& path) {
  FilmReader reader(path);
  SavedFilm saved{reader.header(), Film(reader.header().width, reader.header().height)};
  const PicturePart& part = saved.header.part;
  const TileGrid grid(saved.header.width, saved.header.height);
  std::vector<Film::Pixel> pixels;
  for (std::size_t i = 0; i < part.tile_count(grid); ++i) {
    const Tile tile = grid.tile(part.tile_number(i));
    pixels.resize(tile.pixel_count());
    reader.read_pixels(pixels);
    auto pixel = pixels.cbegin();
    for (std::uint32_t y = tile.first_y; y < tile.end_y; ++y) {
      for (std::uint32_t x = tile.first_x; x < tile.end_x; ++x, ++pixel) {
        if (pixel->taken() > part.samples_per_pixel()) reader.fail("is damaged: a pixel has more samples than there are");
        saved.film.add(x, y, *pixel);
      }
    }
  }
  reader.check_checksum();
  return saved;
}

}  // namespace grove
