#include "grove/build/bottom_up/ploc.h"

#include <algorithm>
#include <utility>

#include "grove/build/bottom_up/morton_order.h"
#include "grove/build/bottom_up/neighbour_search.h"
#include "grove/build/top_down.h"

namespace grove {
namespace {

constexpr std::size_t kChunk = 4096;
// Each round adds at most a level; the rest of the depth is left to the top.
constexpr int kMostRounds = 32;
constexpr std::size_t kTopClusters = 1024;
constexpr std::size_t kSweptClusters = 65536;

// Clusters are numbered: below reference_count they are single references in Morton order, above joined ones.
class ClusterTopology {
 public:
  using Subtree = std::uint32_t;

  explicit ClusterTopology(const HugeVector<PrimitiveReference>& references) : references_(references), joined_(references.size() - 1) {}

  [[nodiscard]] Subtree root() const { return static_cast<std::uint32_t>(references_.size() + joined_.size() - 1); }
  [[nodiscard]] std::uint32_t count(Subtree cluster) const { return is_single(cluster) ? 1 : joined(cluster).count; }
  [[nodiscard]] const PrimitiveReference& reference(Subtree cluster) const { return references_[cluster]; }
  [[nodiscard]] std::pair<Subtree, Subtree> children(Subtree cluster) const { return {joined(cluster).left, joined(cluster).right}; }

  void join(std::uint32_t number, std::uint32_t left, std::uint32_t right) { joined_[number] = {left, right, count(left) + count(right)}; }
  [[nodiscard]] std::uint32_t cluster_of(std::uint32_t number) const { return static_cast<std::uint32_t>(references_.size()) + number; }

 private:
  struct Joined {
    std::uint32_t left, right, count;
  };

  [[nodiscard]] bool is_single(Subtree cluster) const { return cluster < references_.size(); }
  [[nodiscard]] const Joined& joined(Subtree cluster) const { return joined_[cluster - references_.size()]; }

  const HugeVector<PrimitiveReference>& references_;
  HugeVector<Joined> joined_;
};

// A cluster on its place: its box, and its number in the lane where a reference keeps its id.
using Cluster = PrimitiveReference;

Cluster make_cluster(const Box4& box, std::uint32_t number) {
  Int4 lower = reinterpret_cast<Int4>(box.lower);
  lower[3] = static_cast<std::int32_t>(number);
  return {reinterpret_cast<Float4>(lower), box.upper};
}

std::uint32_t number_of(const Cluster& cluster) {
  return static_cast<std::uint32_t>(reinterpret_cast<Int4>(cluster.lower)[3]);
}

class Clustering {
 public:
  Clustering(const HugeVector<PrimitiveReference>& references, ClusterTopology& topology, std::uint32_t radius, float area_scale)
      : topology_(topology),
        radius_(radius),
        area_scale_(area_scale),
        clusters_(references.size()),
        next_(references.size()),
        neighbours_(references.size()) {
    parallel_for(references.size(), kChunk,
                 [&](std::size_t i) { clusters_[i] = make_cluster(references[i].box(), static_cast<std::uint32_t>(i)); });
  }

  void run() {
    for (int round = 0; round < kMostRounds && clusters_.size() > kTopClusters; ++round) {
      find_neighbours();
      join_pairs();
    }
    join_from_the_top();
  }

 private:
  void find_neighbours() {
    const std::size_t count = clusters_.size();
    parallel_chunks(count, kChunk, [&](std::size_t /*chunk*/, std::size_t first, std::size_t last) {
      const std::size_t begin = first > radius_ ? first - radius_ : 0;
      NeighbourSearch search({clusters_.data() + begin, std::min(count, last + radius_) - begin}, begin, area_scale_);
      search.run(radius_);
      for (std::size_t i = first; i < last; ++i) neighbours_[i] = static_cast<std::uint32_t>(begin + search.nearest(i - begin));
    });
  }

  // Joins those that chose each other, at the place of the first; the others keep their order.
  void join_pairs() {
    const std::size_t count = clusters_.size();
    struct Chunk {
      std::uint32_t pairs = 0;
      std::uint32_t kept = 0;
    };
    std::vector<Chunk> chunks((count + kChunk - 1) / kChunk);
    const auto is_pair = [&](std::size_t i) { return neighbours_[i] != i && neighbours_[neighbours_[i]] == i; };
    parallel_chunks(count, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      Chunk counts;
      for (std::size_t i = first; i < last; ++i) {
        const bool pairs = is_pair(i);
        counts.pairs += pairs && i < neighbours_[i] ? 1 : 0;
        counts.kept += !pairs || i < neighbours_[i] ? 1 : 0;
      }
      chunks[chunk] = counts;
    });
    std::uint32_t kept = 0;
    for (Chunk& chunk : chunks) {
      joined_count_ += std::exchange(chunk.pairs, joined_count_);
      kept += std::exchange(chunk.kept, kept);
    }
    parallel_chunks(count, kChunk, [&](std::size_t id, std::size_t first, std::size_t last) {
      Chunk place = chunks[id];
      for (std::size_t i = first; i < last; ++i) {
        if (!is_pair(i)) {
          next_[place.kept++] = clusters_[i];
          continue;
        }
        const std::size_t partner = neighbours_[i];
        if (partner < i) continue;
        Box4 box = clusters_[i].box();
        box.grow(clusters_[partner].box());
        topology_.join(place.pairs, number_of(clusters_[i]), number_of(clusters_[partner]));
        next_[place.kept++] = make_cluster(box, topology_.cluster_of(place.pairs++));
      }
    });
    next_.resize(kept);
    clusters_.swap(next_);
    next_.resize(kept);
  }

  // What is left is few enough to be split by the exact heuristic, which sees further than neighbours on the curve do.
  void join_from_the_top() {
    if (clusters_.size() < 2) return;
    ReferenceList list;
    list.references.resize(clusters_.size());
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      const Box box = clusters_[i].box().box();
      list.references[i] = make_reference(box, static_cast<std::uint32_t>(i));
      list.bounds.grow(box);
    }
    TopDownSettings settings;
    settings.split = clusters_.size() <= kSweptClusters ? ObjectSplit::sweep : ObjectSplit::binned;
    settings.leaf_size = 1;
    settings.most_depth = Bvh2::kMaxDepth - kMostRounds;
    const Bvh2 top = build_top_down(std::move(list), settings);
    // Children stand behind their parents, so that going backwards both are joined before them.
    std::vector<std::uint32_t> numbers(top.nodes.size());
    for (std::size_t i = top.nodes.size(); i-- > 0;) {
      std::uint32_t children[2];
      for (int side = 0; side < 2; ++side) {
        const Bvh2Node::Child link = top.nodes[i].child[side];
        children[side] = link.count > 0 ? number_of(clusters_[top.references[link.first]]) : numbers[link.first];
      }
      topology_.join(joined_count_, children[0], children[1]);
      numbers[i] = topology_.cluster_of(joined_count_++);
    }
  }

  ClusterTopology& topology_;
  std::size_t radius_;
  float area_scale_;
  HugeVector<Cluster> clusters_;
  HugeVector<Cluster> next_;
  HugeVector<std::uint32_t> neighbours_;
  std::uint32_t joined_count_ = 0;
};

}  // namespace

Bvh2 build_ploc(const ReferenceList& list, const BottomUpSettings& settings) {
  if (list.references.empty()) return {};
  HugeVector<PrimitiveReference> references = sort_by_morton_code(list).references;
  ClusterTopology topology(references);
  Clustering(references, topology, settings.radius, AreaMeasure(list.bounds).scale()).run();
  return emit_hierarchy(topology, references.size(), list.bounds, settings);
}

}  // namespace grove
