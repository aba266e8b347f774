#include "grove/render/light/build_light_hierarchy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "grove/base/error.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr int kBinCount = 12;  // as many as the paper's authors take
// Sets of more lights are binned by several tasks, and their halves built by two.
constexpr std::size_t kChunk = 1 << 13;
constexpr std::size_t kTaskSize = 1 << 10;

struct Item {
  LightBounds bounds;
  Vec3 centre;
  std::uint32_t light;
};

struct Bins {
  std::array<std::array<LightBounds, kBinCount>, 3> bins;

  void merge(const Bins& other) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t bin = 0; bin < kBinCount; ++bin) bins.at(axis).at(bin).add(other.bins.at(axis).at(bin));
  }
};

struct Split {
  int axis = -1;  // none
  int bin = 0;    // lights in lower bins go first
};

// What a set is and where its centres lie.
struct Measured {
  LightBounds bounds;
  Box centres;
};

// Area, or something that grows like it where all boxes are lines or points.
float extent_measure(const Box& box, float line_share) {
  const Vec3 extent = box.extent();
  return box.surface_area() + line_share * (extent.x + extent.y + extent.z);
}

int bin_of(const Vec3& centre, const Box& centres, int axis) {
  const float extent = centres.upper[axis] - centres.lower[axis];
  const float place = (centre[axis] - centres.lower[axis]) / extent * static_cast<float>(kBinCount);
  return std::clamp(static_cast<int>(place), 0, kBinCount - 1);
}

bool can_split(const Box& centres, int axis) {
  const float extent = centres.upper[axis] - centres.lower[axis];
  return extent > 0.0F && std::isfinite(extent);
}

bool is_usable(const LightBounds& light) {
  const Vec3 extent = light.box.extent();
  const Vec3 centre = light.box.centre();
  return !light.is_empty() && light.intensity > 0.0F && std::isfinite(light.intensity) && std::isfinite(glm::dot(extent, extent)) &&
         std::isfinite(glm::dot(centre, centre));
}

class Builder {
 public:
  Builder(std::vector<Item>& items, std::uint32_t most_depth, BuiltLightHierarchy& built)
      : items_(items), spare_(items), most_depth_(most_depth), built_(built) {}

  /// Builds the subtree of items [first, end) into `node`; pairs of children go to those from `pair` on.
  void build(std::size_t first, std::size_t end, std::size_t node, std::size_t pair, std::uint32_t depth, std::uint64_t trail) {
    if (end - first == 1) {
      const Item& item = items_[first];
      built_.nodes[node] = LightCluster(item.bounds, item.light, true);
      built_.trails[item.light] = trail;
      return;
    }
    const Measured set = measure(first, end);
    const std::size_t children = 1 + 2 * pair;
    built_.nodes[node] = LightCluster(set.bounds, static_cast<std::uint32_t>(children), false);
    const std::size_t middle = part(first, end, set, depth);
    const auto build_first = [&] { build(first, middle, children, pair + 1, depth + 1, trail); };
    // m lights have m - 1 pairs.
    const auto build_second = [&] {
      build(middle, end, children + 1, pair + (middle - first), depth + 1, trail | std::uint64_t{1} << depth);
    };
    if (end - first > kTaskSize) {
      parallel_invoke(build_first, build_second);
    } else {
      build_first();
      build_second();
    }
  }

 private:
  // Sums in chunks whose borders do not depend on the threads.
  template <typename Sum, typename Add, typename Merge>
  Sum sum(std::size_t first, std::size_t end, const Add& add, const Merge& merge) const {
    std::vector<Sum> sums((end - first + kChunk - 1) / kChunk);
    parallel_chunks(end - first, kChunk, [&](std::size_t chunk, std::size_t begin, std::size_t stop) {
      for (std::size_t i = first + begin; i < first + stop; ++i) add(sums[chunk], items_[i]);
    });
    for (std::size_t chunk = 1; chunk < sums.size(); ++chunk) merge(sums[0], sums[chunk]);
    return std::move(sums[0]);
  }

  [[nodiscard]] Measured measure(std::size_t first, std::size_t end) const {
    return sum<Measured>(
        first, end,
        [](Measured& set, const Item& item) {
          set.bounds.add(item.bounds);
          set.centres.grow(item.centre);
        },
        [](Measured& set, const Measured& other) {
          set.bounds.add(other.bounds);
          set.centres.grow(other.centres);
        });
  }

  [[nodiscard]] Split find_split(std::size_t first, std::size_t end, const Measured& set) const {
    const Bins bins = sum<Bins>(
        first, end,
        [&](Bins& result, const Item& item) {
          for (int axis = 0; axis < 3; ++axis) {
            if (!can_split(set.centres, axis)) continue;
            result.bins.at(static_cast<std::size_t>(axis))
                .at(static_cast<std::size_t>(bin_of(item.centre, set.centres, axis)))
                .add(item.bounds);
          }
        },
        [](Bins& result, const Bins& other) { result.merge(other); });

    const Vec3 extent = set.bounds.box.extent();
    const float longest = std::max({extent.x, extent.y, extent.z});
    const float line_share = set.bounds.box.surface_area() > 0.0F ? 0.0F : 1.0F;
    const auto cost_of = [&](const LightBounds& side) {
      return side.intensity * side.orientation_measure() * extent_measure(side.box, line_share);
    };
    Split best;
    float least = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (!can_split(set.centres, axis)) continue;
      const auto& row = bins.bins.at(static_cast<std::size_t>(axis));
      std::array<float, kBinCount> cost_behind{};
      LightBounds behind;
      for (int bin = kBinCount - 1; bin > 0; --bin) {
        behind.add(row.at(static_cast<std::size_t>(bin)));
        cost_behind.at(static_cast<std::size_t>(bin)) = behind.is_empty() ? -1.0F : cost_of(behind);
      }
      // Against thin slices: k_r of the paper.
      const float regularity = longest / extent[axis];
      LightBounds before;
      for (int bin = 1; bin < kBinCount; ++bin) {
        before.add(row.at(static_cast<std::size_t>(bin - 1)));
        if (before.is_empty() || cost_behind.at(static_cast<std::size_t>(bin)) < 0.0F) continue;
        const float cost = regularity * (cost_of(before) + cost_behind.at(static_cast<std::size_t>(bin)));
        if (!(cost < least)) continue;
        least = cost;
        best = {axis, bin};
      }
    }
    return best;
  }

  // Parts the items and returns where the second set begins.
  std::size_t part(std::size_t first, std::size_t end, const Measured& set, std::uint32_t depth) {
    const std::size_t half = first + (end - first) / 2;
    // From here on, halving ends just above the limit.
    const auto levels_needed = static_cast<std::uint32_t>(std::bit_width(end - first - 1));
    if (depth + levels_needed >= most_depth_) return half;
    const Split split = find_split(first, end, set);
    if (split.axis < 0) return half;
    const auto goes_first = [&](const Item& item) { return bin_of(item.centre, set.centres, split.axis) < split.bin; };
    // Stable, through the spare copy.
    std::size_t count = 0;
    for (std::size_t i = first; i < end; ++i) count += goes_first(items_[i]) ? 1 : 0;
    std::size_t next_first = first;
    std::size_t next_second = first + count;
    for (std::size_t i = first; i < end; ++i) spare_[goes_first(items_[i]) ? next_first++ : next_second++] = items_[i];
    std::copy(spare_.begin() + static_cast<std::ptrdiff_t>(first), spare_.begin() + static_cast<std::ptrdiff_t>(end),
              items_.begin() + static_cast<std::ptrdiff_t>(first));
    return first + count;
  }

  std::vector<Item>& items_;
  std::vector<Item> spare_;
  std::uint32_t most_depth_;
  BuiltLightHierarchy& built_;
};

}  // namespace

BuiltLightHierarchy build_light_hierarchy(std::span<const LightBounds> lights, std::uint32_t most_depth, std::uint64_t no_trail) {
  if (lights.size() > LightCluster::kNumber / 2) throw InputError("the scene has more lights than a light hierarchy can hold: 2^29");
  std::vector<Item> items;
  items.reserve(lights.size());
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightBounds& light = lights[i];
    if (!is_usable(light)) continue;
    items.push_back({light, light.box.centre(), i});
  }
  BuiltLightHierarchy built;
  built.trails.assign(lights.size(), no_trail);
  if (items.empty()) return built;
  built.nodes.resize(2 * items.size() - 1);
  Builder(items, most_depth, built).build(0, items.size(), 0, 0, 0, 0);
  return built;
}

}  // namespace grove
