#include "grove/render/image/write_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <exception>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/output_file.h"

namespace grove {
namespace {

struct Channel {
  const char* name;
  std::size_t offset;  // in floats within Film::Sample
};

static_assert(sizeof(Film::Sample) == 9 * sizeof(float));
constexpr Channel kChannels[] = {{"R", 0},        {"G", 1},        {"B", 2},        {"albedo.R", 3}, {"albedo.G", 4},
                                 {"albedo.B", 5}, {"normal.X", 6}, {"normal.Y", 7}, {"normal.Z", 8}};

}  // namespace

void write_exr(const Film& film, const std::filesystem::path& path) {
  OutputFile file(path);
  std::vector<Film::Sample> pixels;
  pixels.reserve(std::size_t{film.width()} * film.height());
  for (std::uint32_t y = 0; y < film.height(); ++y)
    for (std::uint32_t x = 0; x < film.width(); ++x) pixels.push_back(film.mean(x, y));

  const int width = static_cast<int>(film.width());
  const int height = static_cast<int>(film.height());
  try {
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (const Channel& channel : kChannels) {
      header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
      // OpenEXR's interface wants a mutable pointer but only reads.
      char* base = reinterpret_cast<char*>(pixels.data()) + channel.offset * sizeof(float);
      frame.insert(channel.name, Imf::Slice(Imf::FLOAT, base, sizeof(Film::Sample), sizeof(Film::Sample) * film.width()));
    }
    Imf::OutputFile output(file.working_path().string().c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(height);
  } catch (const std::exception& error) {
    throw OutputError(path.string() + ": cannot write the EXR image: " + error.what());
  }
  file.commit();
}

}  // namespace grove
