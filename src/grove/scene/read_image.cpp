#include "grove/scene/read_image.h"

#include <cstring>
#include <string_view>

#include "grove/base/error.h"
#include "grove/scene/images/decode.h"
#include "grove/scene/read_file.h"

namespace grove {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;

bool starts_with(std::span<const std::byte> data, std::string_view magic) {
  return data.size() >= magic.size() && std::memcmp(data.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

void check_image_size(std::uint64_t width, std::uint64_t height, std::size_t file_bytes, std::uint64_t pixels_per_byte,
                      const std::string& name) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width == 0 || height == 0) throw InputError(name, "", "an image without pixels (" + size + ")");
  if (width > kMaxPixels || height > kMaxPixels || width * height > kMaxPixels) {
    throw InputError(name, "", "an image of " + size + "; the limit is 2^28 pixels");
  }
  if (width * height / pixels_per_byte > file_bytes) {
    throw InputError(name, "", "claims " + size + ", more than its " + std::to_string(file_bytes) + " bytes can hold");
  }
}

Image read_image(const std::filesystem::path& file) {
  return decode_image(read_file(file), file.string());
}

Image decode_image(std::span<const std::byte> data, const std::string& name) {
  if (data.empty()) throw InputError(name, "", "an empty image file");
  Image image = starts_with(data, "\x76\x2f\x31\x01")                ? decode_exr(data, name)
                : starts_with(data, "PF") || starts_with(data, "Pf") ? decode_pfm(data, name)
                                                                     : decode_by_stb(data, name);
  image.name = name;
  return image;
}

}  // namespace grove
