#include "grove/build/fast/pack_fast.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "grove/base/check.h"
#include "grove/base/parallel.h"

namespace grove {
namespace {

constexpr std::size_t kChunk = 1024;

// The children from far to near by where their centres lie along the diagonal of the octant. Unused places come first, as the farthest.
std::uint32_t order_for(const WideNode<8>& node, unsigned octant) {
  float distance[8];
  for (int i = 0; i < 8; ++i) {
    distance[i] = std::numeric_limits<float>::infinity();
    if (!node.has_child(i)) continue;
    const Box box = node.child_box(i);
    distance[i] = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      const float doubled_centre = 0.5F * box.lower[axis] + 0.5F * box.upper[axis];
      distance[i] += (octant >> axis & 1U) != 0 ? -doubled_centre : doubled_centre;
    }
  }
  std::uint32_t places[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  std::stable_sort(places, places + 8, [&](std::uint32_t a, std::uint32_t b) { return distance[a] > distance[b]; });
  std::uint32_t order = 0;
  for (int k = 0; k < 8; ++k) order |= places[k] << (3 * k);
  return order;
}

TriangleBlock pack_block(const std::uint32_t* references, std::uint32_t count, const TriangleMesh& mesh) {
  TriangleBlock block{};
  for (std::uint32_t place = 0; place < count; ++place) {
    const Triangle& triangle = mesh.triangles()[references[place]];
    const std::uint32_t vertices[3] = {triangle.x, triangle.y, triangle.z};
    for (int corner = 0; corner < 3; ++corner)
      for (int axis = 0; axis < 3; ++axis) block.corners[axis][corner][place] = mesh.vertices()[vertices[corner]][axis];
    block.primitive[place] = references[place];
  }
  return block;
}

class Packing {
 public:
  Packing(const WideBvh<8>& bvh, const TriangleMesh& mesh) : bvh_(bvh), mesh_(mesh) {}

  FastBvh run() {
    result_.bounds = bvh_.bounds;
    result_.depth = bvh_.depth;
    result_.references = static_cast<std::uint32_t>(bvh_.references.size());
    if (bvh_.references.empty()) return std::move(result_);
    if (bvh_.nodes.empty()) {
      pack_single_leaf();
      return std::move(result_);
    }
    count_leaves();
    result_.nodes.resize(bvh_.nodes.size());
    parallel_chunks(bvh_.nodes.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      std::uint32_t block = first_block_[chunk];
      for (std::size_t i = first; i < last; ++i) pack_node(i, block);
    });
    return std::move(result_);
  }

 private:
  // A root that is a leaf gets a node above it, so that a traversal always starts at a node.
  void pack_single_leaf() {
    const auto count = static_cast<std::uint32_t>(bvh_.references.size());
    WideNode<8> node = empty_node();
    node.set_child(0, bvh_.bounds, {0, count});
    result_.nodes.resize(1);
    result_.blocks.resize(1);
    result_.depth = 1;
    std::uint32_t block = 0;
    pack(node, result_.nodes[0], block);
  }

  static WideNode<8> empty_node() {
    WideNode<8> node;
    for (int i = 0; i < 8; ++i) node.set_child(i, Box{}, {0, 0});
    return node;
  }

  // The number of the first block of each chunk of nodes.
  void count_leaves() {
    first_block_.assign((bvh_.nodes.size() + kChunk - 1) / kChunk, 0);
    parallel_chunks(bvh_.nodes.size(), kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        for (int place = 0; place < 8; ++place) first_block_[chunk] += bvh_.nodes[i].child[place].count > 0 ? 1 : 0;
    });
    std::uint32_t total = 0;
    for (std::uint32_t& first : first_block_) total += std::exchange(first, total);
    GROVE_CHECK(total <= FastChild::kMostBlocks);
    result_.blocks.resize(total);
  }

  void pack_node(std::size_t i, std::uint32_t& block) { pack(bvh_.nodes[i], result_.nodes[i], block); }

  void pack(const WideNode<8>& from, FastNode& to, std::uint32_t& block) {
    std::copy_n(&from.planes[0][0][0], 3 * 2 * 8, &to.planes[0][0][0]);
    for (unsigned octant = 0; octant < 8; ++octant) to.order[octant] = order_for(from, octant);
    for (int place = 0; place < 8; ++place) {
      const auto [first, count] = from.child[place];
      if (count == 0) {
        to.child[place] = FastChild::node(from.has_child(place) ? first : 0);
        continue;
      }
      GROVE_ASSERT(count <= TriangleBlock::kWidth);
      result_.blocks[block] = pack_block(bvh_.references.data() + first, count, mesh_);
      to.child[place] = FastChild::leaf(block++, count);
    }
  }

  const WideBvh<8>& bvh_;
  const TriangleMesh& mesh_;
  FastBvh result_;
  std::vector<std::uint32_t> first_block_;
};

}  // namespace

FastBvh pack_fast(const WideBvh<8>& bvh, const TriangleMesh& mesh) {
  return Packing(bvh, mesh).run();
}

}  // namespace grove
