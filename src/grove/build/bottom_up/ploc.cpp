#include "grove/build/bottom_up/ploc.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "grove/build/bottom_up/cluster_tree.h"
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

// Clusters that are not yet part of another, in order along the curve.
class Clustering {
 public:
  // `spare` is memory to use.
  Clustering(ClusterTree& tree, std::uint32_t radius, float area_scale, HugeVector<Cluster> spare)
      : tree_(tree),
        radius_(radius),
        area_scale_(area_scale),
        clusters_(tree.references()),
        buffers_{std::move(spare), {}},
        partners_(tree.references().size()) {}

  void run() {
    for (int round = 0; round < kMostRounds && clusters_.size() > kTopClusters; ++round) {
      find_pairs();
      join_pairs();
    }
    join_from_the_top();
  }

 private:
  // What a stretch adds to the joins and the clusters of the next round; then where its share of them begins.
  struct Chunk {
    std::uint32_t pairs = 0;
    std::uint32_t kept = 0;
  };

  // At first the references stand for the clusters.
  [[nodiscard]] Cluster cluster(std::size_t place) const { return is_first_round_ ? tree_.single(place) : clusters_[place]; }

  // Notes for each cluster the one that it is joined with, or itself. A stretch is searched so far beyond its ends that it is known
  // whether the neighbours found choose it as well.
  void find_pairs() {
    const std::size_t count = clusters_.size();
    chunks_.assign((count + kChunk - 1) / kChunk, {});
    parallel_chunks(count, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      const std::size_t begin = first > 2 * radius_ ? first - 2 * radius_ : 0;
      const std::size_t end = std::min(count, last + 2 * radius_);
      NeighbourSearch search(clusters_.subspan(begin, end - begin), begin, area_scale_);
      search.run(radius_);
      Chunk counts;
      for (std::size_t i = first - begin; i < last - begin; ++i) {
        const std::size_t nearest = search.nearest(i);
        const bool is_pair = search.nearest(nearest) == i;
        partners_[begin + i] = static_cast<std::uint32_t>(begin + (is_pair ? nearest : i));
        counts.pairs += is_pair && i < nearest ? 1 : 0;
        counts.kept += is_pair && i > nearest ? 0 : 1;
      }
      chunks_[chunk] = counts;
    });
  }

  // Joins pairs at the place of the first; the others keep their order.
  void join_pairs() {
    std::uint32_t kept = 0;
    for (Chunk& chunk : chunks_) {
      joined_count_ += std::exchange(chunk.pairs, joined_count_);
      kept += std::exchange(chunk.kept, kept);
    }
    HugeVector<Cluster>& next = buffers_[0];
    next.resize(kept);
    parallel_chunks(clusters_.size(), kChunk, [&](std::size_t id, std::size_t first, std::size_t last) {
      Chunk place = chunks_[id];
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t partner = partners_[i];
        if (partner < i) continue;
        next[place.kept++] = partner == i ? cluster(i) : tree_.join(place.pairs++, cluster(i), cluster(partner));
      }
    });
    clusters_ = next;
    is_first_round_ = false;
    buffers_[0].swap(buffers_[1]);
  }

  // What is left is few enough to be split by the exact heuristic, which sees further than neighbours on the curve do.
  void join_from_the_top() {
    if (clusters_.size() < 2) return;
    ReferenceList list;
    list.references.resize(clusters_.size());
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      const Box box = cluster(i).box().box();
      list.references[i] = make_reference(box, static_cast<std::uint32_t>(i));
      list.bounds.grow(box);
    }
    TopDownSettings settings;
    settings.split = clusters_.size() <= kSweptClusters ? ObjectSplit::sweep : ObjectSplit::binned;
    settings.leaf_size = 1;
    settings.most_depth = Bvh2::kMaxDepth - kMostRounds;
    const Bvh2 top = build_top_down(std::move(list), settings);
    // Children stand behind their parents, so that going backwards both are joined before them.
    std::vector<Cluster> joined(top.nodes.size());
    for (std::size_t i = top.nodes.size(); i-- > 0;) {
      Cluster children[2];
      for (int side = 0; side < 2; ++side) {
        const Bvh2Node::Child link = top.nodes[i].child[side];
        children[side] = link.count > 0 ? cluster(top.references[link.first]) : joined[link.first];
      }
      joined[i] = tree_.join(joined_count_++, children[0], children[1]);
    }
  }

  ClusterTree& tree_;
  std::size_t radius_;
  float area_scale_;
  std::span<const Cluster> clusters_;
  bool is_first_round_ = true;
  HugeVector<Cluster> buffers_[2];  // the next round's clusters, and this round's
  HugeVector<std::uint32_t> partners_;
  std::vector<Chunk> chunks_;
  std::uint32_t joined_count_ = 0;
};

}  // namespace

Bvh2 build_ploc(ReferenceList list, const BottomUpSettings& settings) {
  if (list.references.empty()) return {};
  const float area_scale = AreaMeasure(list.bounds).scale();
  ClusterTree tree(gather(list, sort_by_morton_code(list)), SubtreeCost(settings, area_scale));
  Clustering(tree, settings.radius, area_scale, std::move(list.references)).run();
  return tree.hierarchy(list.bounds);
}

}  // namespace grove
