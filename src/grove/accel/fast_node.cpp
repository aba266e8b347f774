#include "grove/accel/fast_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grove {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kMostSteps = 255.0;
// Below that products with the inverse of a direction would lose bits.
constexpr int kLeastExponent = -100;

// The power of two with which so many steps reach over an extent.
int exponent_for(double extent) {
  int exponent = 0;
  std::frexp(extent / kMostSteps, &exponent);  // at most 2^exponent
  return std::max(exponent, kLeastExponent);
}

std::uint8_t step_below(double plane, double origin, double scale) {
  double step = std::clamp(std::floor((plane - origin) / scale), 0.0, kMostSteps);
  while (step > 0.0 && origin + step * scale > plane) --step;
  return static_cast<std::uint8_t>(step);
}

std::uint8_t step_above(double plane, double origin, double scale) {
  double step = std::clamp(std::ceil((plane - origin) / scale), 0.0, kMostSteps);
  while (step < kMostSteps && origin + step * scale < plane) ++step;
  return static_cast<std::uint8_t>(step);
}

float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafter(nearest, -kInfinity) : nearest;
}

float rounded_up(double value) {
  return -rounded_down(-value);
}

}  // namespace

void FastNode::set(const EightBoxes& boxes, int /*count*/, const std::uint32_t orders[8]) {
  bounds = boxes;
  std::copy_n(orders, kWidth, order);
}

void CompressedNode::set(const EightBoxes& boxes, int count, const std::uint32_t orders[8]) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [lower, upper] = boxes.planes[axis];
    origin[axis] = *std::min_element(lower, lower + count);
    const double begin = origin[axis];
    const int exponent = exponent_for(static_cast<double>(*std::max_element(upper, upper + count)) - begin);
    const double size = std::ldexp(1.0, exponent);
    scale[axis] = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(static_cast<float>(size)) >> 16);
    for (int i = 0; i < kWidth; ++i) {
      steps[axis][0][i] = i < count ? step_below(lower[i], begin, size) : static_cast<std::uint8_t>(kMostSteps);
      steps[axis][1][i] = i < count ? step_above(upper[i], begin, size) : 0;
    }
  }
  used = static_cast<std::uint8_t>((1U << count) - 1);
  used_in_order = static_cast<std::uint8_t>(used << (kWidth - count));
  for (int octant = 0; octant < kWidth; ++octant)
    for (int byte = 0; byte < 3; ++byte) order[3 * octant + byte] = static_cast<std::uint8_t>(orders[octant] >> (8 * byte));
  std::fill_n(unused, sizeof unused, std::uint8_t{0});
}

EightBoxes CompressedNode::boxes() const {
  EightBoxes boxes;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = scale_along(axis);
    for (int i = 0; i < kWidth; ++i) {
      boxes.planes[axis][0][i] = has_child(i) ? rounded_down(origin[axis] + steps[axis][0][i] * size) : kInfinity;
      boxes.planes[axis][1][i] = has_child(i) ? rounded_up(origin[axis] + steps[axis][1][i] * size) : -kInfinity;
    }
  }
  return boxes;
}

float CompressedNode::looseness() const {
  return std::max({scale_along(0), scale_along(1), scale_along(2)});
}

}  // namespace grove
