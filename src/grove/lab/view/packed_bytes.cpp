#include "grove/lab/view/packed_bytes.h"

#include <cmath>

namespace grove {

void PackedBytes::add_u16(std::uint16_t value) {
  bytes_.push_back(static_cast<std::uint8_t>(value & 0xffU));
  bytes_.push_back(static_cast<std::uint8_t>(value >> 8U));
}

void PackedBytes::add_float(float value) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<std::uint8_t>(word >> shift & 0xffU));
}

void PackedBytes::add_varint(std::uint64_t value) {
  for (; value >= 0x80U; value >>= 7U) bytes_.push_back(static_cast<std::uint8_t>(value | 0x80U));
  bytes_.push_back(static_cast<std::uint8_t>(value));
}

std::string PackedBytes::base64() const {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes_.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes_.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes_.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < count; ++k) word |= std::uint32_t{bytes_[i + k]} << (16U - 8U * static_cast<unsigned>(k));
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
  }
  return text;
}

Quantiser::Quantiser(const Box& bounds) : bounds_(bounds) {}

double Quantiser::steps(int axis, float value) const {
  const double extent = double{bounds_.upper[axis]} - double{bounds_.lower[axis]};
  if (!(extent > 0.0)) return 0.0;
  const double steps = (double{value} - double{bounds_.lower[axis]}) / extent * double{kSteps};
  // Written so that NaN becomes 0.
  if (!(steps > 0.0)) return 0.0;
  return steps < double{kSteps} ? steps : double{kSteps};
}

std::uint16_t Quantiser::nearest(int axis, float value) const {
  return static_cast<std::uint16_t>(std::lround(steps(axis, value)));
}

std::uint16_t Quantiser::below(int axis, float value) const {
  return static_cast<std::uint16_t>(std::floor(steps(axis, value)));
}

std::uint16_t Quantiser::above(int axis, float value) const {
  return static_cast<std::uint16_t>(std::ceil(steps(axis, value)));
}

void Quantiser::add_point(PackedBytes& bytes, const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis) bytes.add_u16(nearest(axis, point[axis]));
}

void Quantiser::add_box(PackedBytes& bytes, const Box& box) const {
  const bool is_empty = box.is_empty();
  for (int axis = 0; axis < 3; ++axis) bytes.add_u16(is_empty ? 0 : below(axis, box.lower[axis]));
  for (int axis = 0; axis < 3; ++axis) bytes.add_u16(is_empty ? 0 : above(axis, box.upper[axis]));
}

}  // namespace grove
