// OpenEXR by its own library, from memory. Before the library sees a file, the data window is read from the header here: the library
// allocates its table of line offsets from it before a caller could check it.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "grove/base/error.h"
#include "grove/scene/images/decode.h"

namespace grove {
namespace {

// Deflate's limit of 1032, for one channel of two bytes; wavelet and DCT compression stay below it on real pictures.
constexpr std::uint64_t kPixelsPerByte = 1024;

/// The bytes in memory as the library's stream.
class MemoryStream final : public Imf::IStream {
 public:
  MemoryStream(std::span<const std::byte> data, const std::string& name) : IStream(name.c_str()), data_(data) {}

  bool read(char* target, int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > data_.size() - position_) throw std::runtime_error("the file is cut short");
    std::memcpy(target, data_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::size_t>(count);
    return position_ < data_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override {
    if (position > data_.size()) throw std::runtime_error("an offset points past the end of the file");
    position_ = static_cast<std::size_t>(position);
  }

 private:
  std::span<const std::byte> data_;
  std::size_t position_ = 0;
};

/// Walks the header's attributes: name, type (both ended by a zero byte), little-endian size, value.
class HeaderWalk {
 public:
  HeaderWalk(std::span<const std::byte> data, const std::string& name)
      : text_(reinterpret_cast<const char*>(data.data()), data.size()), name_(name) {
    text_.remove_prefix(std::min<std::size_t>(8, text_.size()));
  }

  /// x and y of the lower and the upper corner, both inclusive.
  std::array<std::int32_t, 4> data_window() {
    for (;;) {
      const std::string_view attribute = take_string();
      if (attribute.empty()) fail("has no data window");
      take_string();
      const auto size = take_integer();
      if (size < 0 || static_cast<std::size_t>(size) > text_.size()) fail("has a header that is cut short");
      if (attribute == "dataWindow") return {take_integer(), take_integer(), take_integer(), take_integer()};
      text_.remove_prefix(static_cast<std::size_t>(size));
    }
  }

 private:
  std::string_view take_string() {
    const std::size_t end = text_.find('\0');
    if (end == std::string_view::npos) fail("has a header that is cut short");
    const std::string_view value = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return value;
  }

  std::int32_t take_integer() {
    if (text_.size() < 4) fail("has a header that is cut short");
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(text_[i])} << (8 * i);
    text_.remove_prefix(4);
    return static_cast<std::int32_t>(value);
  }

  [[noreturn]] void fail(std::string_view problem) const { throw InputError(name_, "EXR header", problem); }

  std::string_view text_;
  const std::string& name_;
};

// The channels that are there, in the order of Image: Y or RGB, and A.
std::vector<const char*> channel_names(const Imf::ChannelList& channels, const std::string& name) {
  std::vector<const char*> names;
  if (channels.findChannel("R") != nullptr && channels.findChannel("G") != nullptr && channels.findChannel("B") != nullptr) {
    names = {"R", "G", "B"};
  } else if (channels.findChannel("Y") != nullptr) {
    names = {"Y"};
  } else {
    throw InputError(name, "", "an EXR image without the channels R, G and B, or Y");
  }
  if (channels.findChannel("A") != nullptr) names.push_back("A");
  return names;
}

}  // namespace

Image decode_exr(std::span<const std::byte> data, const std::string& name) {
  const auto [left, top, right, bottom] = HeaderWalk(data, name).data_window();
  const std::int64_t width = std::int64_t{right} - left + 1;
  const std::int64_t height = std::int64_t{bottom} - top + 1;
  check_image_size(static_cast<std::uint64_t>(std::max<std::int64_t>(width, 0)),
                   static_cast<std::uint64_t>(std::max<std::int64_t>(height, 0)), data.size(), kPixelsPerByte, name);
  try {
    MemoryStream stream(data, name);
    Imf::InputFile file(stream, 0);
    const Imath::Box2i window = file.header().dataWindow();
    if (window != Imath::Box2i({left, top}, {right, bottom})) throw std::runtime_error("two data windows");
    const std::vector<const char*> names = channel_names(file.header().channels(), name);

    Image image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.channels = static_cast<std::uint32_t>(names.size());
    image.floats.resize(std::size_t{image.width} * image.height * image.channels);
    const std::size_t pixel = image.channels * sizeof(float);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
      frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.floats.data() + c, window, pixel, pixel * image.width));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(name, "", "an EXR image that cannot be read: " + std::string(error.what()));
  }
}

}  // namespace grove
