#include "grove/build/kd_tree/median_planes.h"

#include <algorithm>
#include <bit>

#include "grove/base/parallel.h"

namespace grove {
namespace {

// A position as a number in the same order.
std::uint32_t key_of(float position) {
  const auto bits = std::bit_cast<std::uint32_t>(position + 0.0F);
  return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

float position_of(std::uint32_t key) {
  return std::bit_cast<float>((key & 0x80000000U) != 0 ? key & 0x7fffffffU : ~key);
}

// Of where the references begin and end, the position with `rank` others before it: digit by digit from the top, counting in parallel.
float select_end(const References& references, int axis, std::size_t rank) {
  constexpr std::uint32_t kDigits = 1U << 11U;
  std::uint32_t prefix = 0;
  std::uint32_t known = 0;  // mask of the bits in prefix
  for (const int shift : {21, 10, 0}) {
    const std::uint32_t digits = shift == 0 ? 1U << 10U : kDigits;
    std::vector<std::vector<std::uint32_t>> chunks((references.size() + kBuildChunkSize - 1) / kBuildChunkSize);
    parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t id, std::size_t first, std::size_t last) {
      chunks[id].assign(digits, 0);
      for (std::size_t i = first; i < last; ++i) {
        for (const float end : {static_cast<float>(references[i].lower[axis]), static_cast<float>(references[i].upper[axis])}) {
          const std::uint32_t key = key_of(end);
          if ((key & known) == prefix) ++chunks[id][key >> static_cast<unsigned>(shift) & (digits - 1)];
        }
      }
    });
    for (std::size_t id = 1; id < chunks.size(); ++id)
      for (std::uint32_t digit = 0; digit < digits; ++digit) chunks[0][digit] += chunks[id][digit];
    std::uint32_t digit = 0;
    for (; rank >= chunks[0][digit]; ++digit) rank -= chunks[0][digit];
    prefix |= digit << static_cast<unsigned>(shift);
    known |= (digits - 1) << static_cast<unsigned>(shift);
  }
  return position_of(prefix);
}

// With as many begins and ends below as above: then as many references reach below as above.
float median_end(const References& references, int axis, std::vector<float>& ends) {
  const std::size_t rank = references.size();
  if (references.size() > kKdParallelSize) return select_end(references, axis, rank);
  ends.resize(2 * references.size());
  for (std::size_t i = 0; i < references.size(); ++i) {
    ends[2 * i] = references[i].lower[axis];
    ends[2 * i + 1] = references[i].upper[axis];
  }
  std::nth_element(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(rank), ends.end());
  return ends[rank];
}

void count_sides(const References& references, KdPlane& plane) {
  if (references.size() <= kKdParallelSize) {
    for (const PrimitiveReference& reference : references) plane.count(plane.side(reference));
    return;
  }
  std::vector<KdPlane> chunks((references.size() + kBuildChunkSize - 1) / kBuildChunkSize, plane);
  parallel_chunks(references.size(), kBuildChunkSize, [&](std::size_t id, std::size_t first, std::size_t last) {
    KdPlane counted = plane;
    for (std::size_t i = first; i < last; ++i) counted.count(plane.side(references[i]));
    chunks[id] = counted;
  });
  for (const KdPlane& chunk : chunks) {
    plane.lower_count += chunk.lower_count;
    plane.upper_count += chunk.upper_count;
  }
}

}  // namespace

KdPlane MedianPlanes::find(const ReferenceSet& set, const Box4& cell, Scratch& scratch) const {
  int axes[3] = {0, 1, 2};
  const Float4 side = cell.upper - cell.lower;
  std::stable_sort(axes, axes + 3, [&](int a, int b) { return side[a] > side[b]; });
  for (const int axis : axes) {
    KdPlane plane;
    plane.axis = axis;
    plane.position = of_ == Of::space ? 0.5F * cell.lower[axis] + 0.5F * cell.upper[axis] : median_end(set.references, axis, scratch.ends);
    if (!is_inside(cell, axis, plane.position)) continue;
    plane.is_possible = true;
    count_sides(set.references, plane);
    plane.cost = costs().of(cell).of_plane(axis, plane.position, plane.lower_count, plane.upper_count);
    return plane;
  }
  return {};
}

}  // namespace grove
