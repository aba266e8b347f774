#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>

#include "grove/registry/accelerator.h"

namespace grove {

/// The levels of a tree, both ends included.
struct DepthRange {
  std::uint32_t first = 0;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
};

/// Writes the boxes of a structure's nodes as a Wavefront OBJ file of lines, a group ("depth_3") for each run of nodes of one level; any
/// modeller shows it. Empty and unbounded boxes are left out. Returns the number of boxes. Throws OutputError.
std::uint64_t write_node_boxes(const std::filesystem::path& path, const Accelerator& accelerator, const DepthRange& depths = {});

}  // namespace grove
