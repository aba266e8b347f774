#include "grove/build/fast/pack_fast.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
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

// The same node with the smallest box in the first place and the largest in the last.
WideNode<8> by_area(const WideNode<8>& node) {
  struct Place {
    float area;
    int place;
  };
  Place places[8];
  int count = 0;
  for (; count < 8 && node.has_child(count); ++count) places[count] = {node.child_box(count).half_area(), count};
  std::sort(places, places + count, [](const Place& a, const Place& b) { return a.area != b.area ? a.area < b.area : a.place < b.place; });
  WideNode<8> sorted = node;
  for (int i = 0; i < count; ++i) sorted.set_child(i, node.child_box(places[i].place), node.child[places[i].place]);
  return sorted;
}

void put(const TriangleMesh& mesh, std::uint32_t primitive, int place, TriangleBlock& block) {
  const Triangle& triangle = mesh.triangles()[primitive];
  for (int corner = 0; corner < 3; ++corner)
    for (int axis = 0; axis < 3; ++axis) block.corners[axis][corner][place] = mesh.vertices()[triangle[corner]][axis];
}

void put(const TriangleMesh& mesh, std::uint32_t primitive, int place, IndexedBlock& block) {
  for (int corner = 0; corner < 3; ++corner) block.vertex[corner][place] = mesh.triangles()[primitive][corner];
}

template <typename Block>
Block pack_block(std::span<const std::uint32_t> references, const TriangleMesh& mesh) {
  Block block;
  int places = 0;
  const auto append = [&](std::uint32_t primitive) {
    put(mesh, primitive, places, block);
    block.primitive[places++] = primitive;
  };
  // Leaves that a collapse has joined may name a primitive more than once.
  for (const std::uint32_t primitive : references)
    if (std::find(block.primitive, block.primitive + places, primitive) == block.primitive + places) append(primitive);
  while (places < Block::kWidth) append(references[0]);
  return block;
}

template <typename Bvh>
class Packing {
  using Node = typename Bvh::Node;
  using Block = typename Bvh::Block;
  using Child = typename Bvh::Child;

 public:
  Packing(const WideBvh<8>& bvh, const TriangleMesh& mesh) : bvh_(bvh), mesh_(mesh) {}

  Bvh run() {
    if (!bvh_.references.empty()) bvh_.nodes.empty() ? pack_single_leaf() : pack_nodes();
    result_.bounds = bvh_.bounds;
    return std::move(result_);
  }

 private:
  // A root that is a leaf gets a node above it, so that a traversal always starts at a node.
  void pack_single_leaf() {
    const auto count = static_cast<std::uint32_t>(bvh_.references.size());
    WideNode<8> node = empty_node();
    node.set_child(0, bvh_.bounds, {0, count});
    result_ = Bvh(1, 1);
    result_.depth = 1;
    std::size_t block = 0;
    result_.references = pack(node, result_.nodes()[0], block);
  }

  void pack_nodes() {
    const std::size_t size = bvh_.nodes.size();
    std::vector<std::size_t> first_block((size + kChunk - 1) / kChunk, 0);
    parallel_chunks(size, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        for (const auto& child : bvh_.nodes[i].child) first_block[chunk] += child.count > 0 ? 1 : 0;
    });
    std::size_t block_count = 0;
    for (std::size_t& first : first_block) block_count += std::exchange(first, block_count);
    result_ = Bvh(size, block_count);
    result_.depth = bvh_.depth;
    std::vector<std::uint32_t> references(first_block.size(), 0);
    parallel_chunks(size, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      std::size_t block = first_block[chunk];
      for (std::size_t i = first; i < last; ++i) references[chunk] += pack(bvh_.nodes[i], result_.nodes()[i], block);
    });
    for (const std::uint32_t count : references) result_.references += count;
  }

  static WideNode<8> empty_node() {
    WideNode<8> node;
    for (int i = 0; i < 8; ++i) node.set_child(i, Box{}, {0, 0});
    return node;
  }

  // Writes a node, and its leaves from block number `block` on. Returns how many triangles these hold.
  std::uint32_t pack(const WideNode<8>& unsorted, Node& to, std::size_t& block) {
    const WideNode<8> from = by_area(unsorted);
    std::uint32_t references = 0;
    EightBoxes boxes;
    static_assert(sizeof boxes.planes == sizeof from.planes);
    std::copy_n(&from.planes[0][0][0], 3 * 2 * 8, &boxes.planes[0][0][0]);
    int children = 0;
    while (children < 8 && from.has_child(children)) ++children;
    std::uint32_t orders[8];
    for (unsigned octant = 0; octant < 8; ++octant) orders[octant] = order_for(from, octant);
    to.set(boxes, children, orders);
    for (int place = 0; place < 8; ++place) {
      const auto [first, count] = from.child[place];
      if (count == 0) {
        to.child[place] = Child::node(from.has_child(place) ? first : 0);
        continue;
      }
      GROVE_ASSERT(count <= Block::kWidth);
      result_.blocks()[block] = pack_block<Block>({bvh_.references.data() + first, count}, mesh_);
      references += result_.blocks()[block].count();
      to.child[place] = result_.leaf(block++);
    }
    return references;
  }

  const WideBvh<8>& bvh_;
  const TriangleMesh& mesh_;
  Bvh result_;
};

}  // namespace

template <typename Bvh>
Bvh pack_fast(const WideBvh<8>& bvh, const TriangleMesh& mesh) {
  return Packing<Bvh>(bvh, mesh).run();
}
template FastBvh pack_fast(const WideBvh<8>& bvh, const TriangleMesh& mesh);
template CompressedFastBvh pack_fast(const WideBvh<8>& bvh, const TriangleMesh& mesh);

}  // namespace grove
