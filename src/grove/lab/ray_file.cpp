#include "grove/lab/ray_file.h"

#include <array>
#include <bit>
#include <string>
#include <system_error>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/lab/npy_header.h"

namespace grove {
namespace {

// Rays and hits are read and written as they lie in memory.
static_assert(std::endian::native == std::endian::little, "NumPy files are read and written as they are in memory");

constexpr std::uint64_t kFloatsPerRay = 8;
constexpr std::string_view kWanted = "rays are float32 of shape (N, 8) in C order";
constexpr std::string_view kRayType = "'<f4'";
constexpr std::string_view kHitType =
    "[('t', '<f4'), ('u', '<f4'), ('v', '<f4'), ('primitive', '<u4'), ('geometry', '<u4'), ('instance', '<u4')]";

std::string shape_text(std::span<const std::uint64_t> shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

template <typename Record>
void write_records(const std::filesystem::path& path, std::string_view type, std::span<const std::uint64_t> shape,
                   std::span<const Record> records) {
  OutputFile file(path);
  file.write(format_npy_header(type, shape));
  file.write(records.data(), records.size_bytes());
  file.commit();
}

}  // namespace

RayFile::RayFile(const std::filesystem::path& path) : path_(path) {
  const std::string name = path.string();
  std::error_code error;
  const std::uint64_t file_size = std::filesystem::file_size(path, error);
  if (error) throw InputError(name, "", "cannot be read (" + error.message() + ")");
  stream_.open(path, std::ios::binary);
  if (!stream_) throw InputError(name, "", "cannot be opened for reading");

  const NpyHeader header = read_npy_header(stream_, name, file_size);
  const auto refuse = [&](const std::string& problem) { throw InputError(name, "", problem + "; " + std::string(kWanted)); };
  if (header.descr == ">f4") refuse("holds big-endian numbers");
  if (header.descr != "<f4") refuse("holds elements of type " + header.descr);
  if (header.shape.size() != 2 || header.shape[1] != kFloatsPerRay) refuse("has shape " + shape_text(header.shape));
  if (header.fortran_order) refuse("is in Fortran order");

  data_offset_ = header.data_offset;
  ray_count_ = header.shape[0];
  const std::uint64_t data_size = file_size - data_offset_;
  // Divided rather than multiplied, so that a huge count cannot overflow.
  if (data_size % sizeof(Ray) != 0 || data_size / sizeof(Ray) != ray_count_) {
    throw InputError(name, "",
                     "should hold " + std::to_string(ray_count_) + " rays of " + std::to_string(sizeof(Ray)) + " bytes but has " +
                         std::to_string(data_size) + " bytes of data");
  }
}

std::vector<Ray> RayFile::read() {
  std::vector<Ray> rays(ray_count_);
  stream_.seekg(static_cast<std::streamoff>(data_offset_));
  if (!stream_.read(reinterpret_cast<char*>(rays.data()), static_cast<std::streamsize>(rays.size() * sizeof(Ray)))) {
    throw InputError(path_.string(), "", "cannot be read to its end");
  }
  return rays;
}

void write_rays(const std::filesystem::path& path, std::span<const Ray> rays) {
  write_records(path, kRayType, std::array{std::uint64_t{rays.size()}, kFloatsPerRay}, rays);
}

void write_hits(const std::filesystem::path& path, std::span<const Hit> hits) {
  write_records(path, kHitType, std::array{std::uint64_t{hits.size()}}, hits);
}

}  // namespace grove
