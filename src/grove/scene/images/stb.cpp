// PNG, JPEG, BMP, TGA and Radiance HDR, by stb_image. Its other formats stay out: they have a history of faults on malformed files.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
// The header defines the whole interface in this file, most of it unused.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <limits>
#include <memory>
#include <string>

#include "grove/base/error.h"
#include "grove/scene/images/decode.h"

namespace grove {
namespace {

// The most pixels that one byte of file can stand for. PNG: deflate repeats 1032 bytes a byte (258 bytes in two bits), and one bit may
// be a pixel. JPEG: two bits at least for an 8 x 8 block, half of that where later scans refine it. The others have simple run lengths.
constexpr std::uint64_t kPngPixelsPerByte = 1032 * 8;
constexpr std::uint64_t kOtherPixelsPerByte = 512;

struct FreePixels {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

bool is_png(std::span<const std::byte> data) {
  return data.size() >= 4 && data[0] == std::byte{0x89} && data[1] == std::byte{'P'} && data[2] == std::byte{'N'};
}

[[noreturn]] void fail(const std::string& name) {
  const char* reason = stbi_failure_reason();
  throw InputError(
      name, "",
      "not an image that can be read (PNG, JPEG, TGA, BMP, HDR, PFM or EXR): " + std::string(reason != nullptr ? reason : "broken"));
}

}  // namespace

Image decode_by_stb(std::span<const std::byte> data, const std::string& name) {
  if (data.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw InputError(name, "", "an image file of 2 GiB or more");
  }
  const auto* bytes = reinterpret_cast<const stbi_uc*>(data.data());
  const int length = static_cast<int>(data.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(bytes, length, &width, &height, &channels) == 0 || width < 0 || height < 0) fail(name);
  check_image_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), data.size(),
                   is_png(data) ? kPngPixelsPerByte : kOtherPixelsPerByte, name);

  Image image;
  const auto take = [&](const auto* pixels, auto& values) {
    if (pixels == nullptr || width <= 0 || height <= 0 || channels < 1 || channels > 4) fail(name);
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.channels = static_cast<std::uint32_t>(channels);
    values.assign(pixels, pixels + std::size_t{image.width} * image.height * image.channels);
  };
  if (stbi_is_hdr_from_memory(bytes, length) != 0) {
    const std::unique_ptr<float, FreePixels> pixels(stbi_loadf_from_memory(bytes, length, &width, &height, &channels, 0));
    take(pixels.get(), image.floats);
  } else {
    const std::unique_ptr<stbi_uc, FreePixels> pixels(stbi_load_from_memory(bytes, length, &width, &height, &channels, 0));
    take(pixels.get(), image.bytes);
  }
  return image;
}

}  // namespace grove
