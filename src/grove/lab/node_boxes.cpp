#include "grove/lab/node_boxes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

#include "grove/base/output_file.h"

namespace grove {
namespace {

/// Corner i has the upper x, y, z where bits 0, 1, 2 of i are set. Edges join corners that differ in one bit.
constexpr std::array<std::array<int, 2>, 12> kEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

bool is_finite(const Box& box) {
  const Vec3 sum = 0.0F * box.lower + 0.0F * box.upper;
  return sum.x + sum.y + sum.z == 0.0F;
}

}  // namespace

std::uint64_t write_node_boxes(const std::filesystem::path& path, const Accelerator& accelerator, const DepthRange& depths) {
  OutputFile file(path);
  file.write(fmt::format("# nodes of {}\n", accelerator.spec()));
  std::uint64_t box_count = 0;
  std::int64_t group = -1;
  fmt::memory_buffer text;
  accelerator.visit_nodes([&](const NodeView& node) {
    if (node.depth < depths.first || node.depth > depths.last || node.box.is_empty() || !is_finite(node.box)) return;
    text.clear();
    const auto out = std::back_inserter(text);
    if (group != node.depth) fmt::format_to(out, "g depth_{}\n", node.depth);
    group = node.depth;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p((corner & 1) != 0 ? node.box.upper.x : node.box.lower.x, (corner & 2) != 0 ? node.box.upper.y : node.box.lower.y,
                   (corner & 4) != 0 ? node.box.upper.z : node.box.lower.z);
      fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
    }
    // OBJ counts vertices from 1; negative numbers count back from the last, which keeps the file short.
    for (const auto& [from, to] : kEdges) fmt::format_to(out, "l {} {}\n", from - 8, to - 8);
    file.write({text.data(), text.size()});
    ++box_count;
  });
  file.commit();
  return box_count;
}

}  // namespace grove
