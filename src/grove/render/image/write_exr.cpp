#include "grove/render/image/write_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <exception>
#include <string>
#include <variant>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/output_file.h"

namespace grove {
namespace {

struct Plane {
  std::string name;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;
};

// The picture, channel by channel.
class Planes {
 public:
  Planes(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

  /// Adds one channel for each of `names`; `value(x, y)` gives a colour, a vector or a number.
  template <typename Value>
  void add(const std::vector<std::string>& names, const Value& value) {
    using Number = decltype(component(value(0, 0), 0));
    std::vector<std::vector<Number>> planes(names.size(), std::vector<Number>(std::size_t{width_} * height_));
    for (std::uint32_t y = 0; y < height_; ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        const auto all = value(x, y);
        for (std::size_t i = 0; i < names.size(); ++i) planes[i][std::size_t{y} * width_ + x] = component(all, static_cast<int>(i));
      }
    }
    planes_.reserve(planes_.size() + names.size());
    for (std::size_t i = 0; i < names.size(); ++i) planes_.push_back({names[i], std::move(planes[i])});
  }

  void write(const std::filesystem::path& path) {
    Imf::Header header(static_cast<int>(width_), static_cast<int>(height_));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (Plane& plane : planes_) {
      const Imf::PixelType type = std::holds_alternative<std::vector<float>>(plane.values) ? Imf::FLOAT : Imf::UINT;
      header.channels().insert(plane.name, Imf::Channel(type));
      // Either number has four bytes. OpenEXR's interface wants a mutable pointer but only reads.
      char* const base = std::visit([](auto& values) { return reinterpret_cast<char*>(values.data()); }, plane.values);
      frame.insert(plane.name, Imf::Slice(type, base, 4, 4 * std::size_t{width_}));
    }
    Imf::OutputFile output(path.string().c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(static_cast<int>(height_));
  }

 private:
  template <int kCount, typename Number>
  static Number component(const glm::vec<kCount, Number, glm::defaultp>& all, int i) {
    return all[i];
  }
  static float component(float value, int /*i*/) { return value; }

  std::uint32_t width_;
  std::uint32_t height_;
  std::vector<Plane> planes_;
};

Planes planes_of(const RenderResult& result, LayerSet layers) {
  const Film& film = result.film;
  Planes planes(film.width(), film.height());
  const ColourImage colours = result.colours();
  planes.add({"R", "G", "B"}, [&](auto x, auto y) { return colours.at(x, y); });
  if (layers.has(Layer::noisy) && result.denoised) {
    planes.add({"noisy.R", "noisy.G", "noisy.B"}, [&](auto x, auto y) { return film.mean(x, y).radiance; });
  }
  if (layers.has(Layer::albedo)) {
    planes.add({"albedo.R", "albedo.G", "albedo.B"}, [&](auto x, auto y) { return film.mean(x, y).albedo; });
  }
  if (layers.has(Layer::normal)) {
    planes.add({"normal.X", "normal.Y", "normal.Z"}, [&](auto x, auto y) { return film.mean(x, y).normal; });
  }
  if (layers.has(Layer::samples)) {
    planes.add({"samples.Y"}, [&](auto x, auto y) { return static_cast<float>(film.pixel(x, y).sample_count); });
  }
  if (layers.has(Layer::variance)) {
    planes.add({"variance.Y"}, [&](auto x, auto y) { return film.variance_of_mean(x, y); });
  }
  if (!result.first_hits) return planes;
  const FirstHits& hits = *result.first_hits;
  if (layers.has(Layer::depth)) planes.add({"depth.Z"}, [&](auto x, auto y) { return hits.at(x, y).depth; });
  if (layers.has(Layer::motion)) {
    planes.add({"motion.U", "motion.V"}, [&](auto x, auto y) { return Vec2(hits.at(x, y).motion.x, -hits.at(x, y).motion.y); });
  }
  if (layers.has(Layer::id)) {
    planes.add({"id.primitive", "id.geometry", "id.instance"}, [&](auto x, auto y) {
      const FirstHit& hit = hits.at(x, y);
      return glm::uvec3(hit.primitive, hit.geometry, hit.instance);
    });
  }
  return planes;
}

}  // namespace

void write_exr(const RenderResult& result, LayerSet layers, const std::filesystem::path& path) {
  OutputFile file(path);
  Planes planes = planes_of(result, layers);
  try {
    planes.write(file.working_path());
  } catch (const std::exception& error) {
    throw OutputError(path.string() + ": cannot write the EXR image: " + error.what());
  }
  file.commit();
}

}  // namespace grove
