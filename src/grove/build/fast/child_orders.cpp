#include "grove/build/fast/child_orders.h"

#include <utility>

#include "grove/math/float4.h"

namespace grove {
namespace {

// A place in an order is the power of eight there, by octant: to come one place later is to be multiplied by eight, and the order is the sum of all
// numbers of children times their places.
void move_back(Int4& place, Int4 condition) {
  place += condition & ((place << 3) - place);
}

}  // namespace

// No sort: of each pair it is found which is farther, for four octants at a time. In the opposite octants all distances are the same but for the sign.
void order_children(const EightBoxes& boxes, int count, std::uint32_t orders[8]) {
  Float4 distance[8];
  Int4 place[8];
  Int4 opposite_place[8];
  const std::int32_t first = 1 << (3 * (8 - count));
  for (int i = 0; i < count; ++i) {
    const auto centre = [&](int axis) { return 0.5F * boxes.planes[axis][0][i] + 0.5F * boxes.planes[axis][1][i]; };
    const float x = centre(0);
    const float y = centre(1);
    distance[i] = Float4{x, -x, x, -x} + Float4{y, y, -y, -y} + splat(centre(2));
    place[i] = opposite_place[i] = Int4{first, first, first, first};
    for (int k = 0; k < i; ++k) {
      const Int4 is_farther = distance[i] > distance[k];
      const Int4 is_nearer = distance[i] < distance[k];
      move_back(place[k], is_farther);
      move_back(place[i], ~is_farther);
      move_back(opposite_place[k], is_nearer);
      move_back(opposite_place[i], ~is_nearer);
    }
  }
  Int4 order{};
  Int4 opposite{};
  for (int i = count; i < 8; ++i) order += i << (3 * (i - count));
  opposite = order;
  for (int i = 1; i < count; ++i) {
    order += i * place[i];
    opposite += i * opposite_place[i];
  }
  for (int octant = 0; octant < 4; ++octant) {
    orders[octant] = static_cast<std::uint32_t>(order[octant]);
    orders[7 - octant] = static_cast<std::uint32_t>(opposite[octant]);
  }
}

}  // namespace grove
