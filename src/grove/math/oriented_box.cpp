#include "grove/math/oriented_box.h"

#include <algorithm>
#include <cmath>

#include "grove/math/rounding.h"

namespace grove {

OrientedBox OrientedBox::aligned(const Box& box) {
  OrientedBox result{};
  for (int axis = 0; axis < 3; ++axis) {
    result.axes[axis][axis] = 1.0F;
    result.lower[axis] = box.lower[axis];
    result.upper[axis] = box.upper[axis];
  }
  return result;
}

Box OrientedBox::bounds() const {
  // The transpose stands for the inverse, which it is but for the rounding of the axes: up to four units in the last place of a coordinate.
  double slack = 0.0;
  for (int axis = 0; axis < 3; ++axis) slack += std::max(std::fabs(lower[axis]), std::fabs(upper[axis]));
  slack *= 5e-7;
  Box box;
  for (int component = 0; component < 3; ++component) {
    double low = -slack;
    double high = slack;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = static_cast<double>(axes[component][axis]) * lower[axis];
      const double b = static_cast<double>(axes[component][axis]) * upper[axis];
      low += std::min(a, b);
      high += std::max(a, b);
    }
    box.lower[component] = round_down(low);
    box.upper[component] = round_up(high);
  }
  return box;
}

}  // namespace grove
