#include "grove/build/passes/reinsertion.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/build/passes/slot_tree.h"
#include "grove/build/split.h"

namespace grove {
namespace {

// Slots that one task goes through.
constexpr std::size_t kChunk = 1024;

struct Move {
  std::uint32_t from = 0;  ///< the slot that is taken out
  std::uint32_t to = 0;    ///< the slot whose content it is joined with
  float gain = 0.0F;       ///< of scaled half area
};

class Reinserter {
 public:
  explicit Reinserter(const Bvh2& bvh) : tree_(bvh), scale_(AreaMeasure(bvh.bounds).scale()) {}

  // One round over the slots of which is_candidate(slot) is true. Those of the root stay: taking one out would leave a root with one child.
  template <typename IsCandidate>
  void run_round(const IsCandidate& is_candidate) {
    const std::size_t slot_count = 2 * std::size_t{tree_.node_count()};
    std::vector<std::vector<Move>> found((slot_count + kChunk - 1) / kChunk);
    parallel_chunks(slot_count, kChunk, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      std::vector<Pending> stack;
      for (std::size_t i = std::max<std::size_t>(first, 2); i < last; ++i) {
        const auto slot = static_cast<std::uint32_t>(i);
        if (!is_candidate(slot)) continue;
        const Move move = find_best(slot, stack);
        if (move.gain > 0.0F) found[chunk].push_back(move);
      }
    });
    std::vector<Move> moves;
    for (const std::vector<Move>& of_chunk : found) moves.insert(moves.end(), of_chunk.begin(), of_chunk.end());
    parallel_sort(moves, [](const Move& a, const Move& b) { return a.gain != b.gain ? a.gain > b.gain : a.from < b.from; });
    touched_.assign(tree_.node_count(), 0);
    for (const Move& move : moves) apply(move);
  }

  void run_round(std::uint32_t phase, std::uint32_t stride) {
    run_round([=](std::uint32_t slot) { return (slot - 2) % stride == phase; });
  }

  // One round over about that share of the slots whose areas are largest.
  void run_round_of_largest(double share) {
    const float least = area_exceeded_by(share);
    run_round([&](std::uint32_t slot) { return area(tree_.slots[slot].box()) > least; });
  }

  // Sum of the scaled half areas of all boxes but the root's.
  [[nodiscard]] double total_area() const {
    double sum = 0.0;
    for (std::uint32_t node = 1; node < tree_.node_count(); ++node) sum += area(tree_.slots[tree_.parent_slot[node]].box());
    return sum;
  }

  [[nodiscard]] const SlotTree& tree() const { return tree_; }

 private:
  struct Pending {
    float gain;  ///< when joined below, without the new box
    std::uint32_t slot;
  };

  [[nodiscard]] float area(const Box4& box) const { return scaled_half_area(box, scale_); }

  // Judged by every 16th slot.
  [[nodiscard]] float area_exceeded_by(double share) const {
    constexpr std::size_t kSampled = 16;
    std::vector<float> areas((tree_.slots.size() + kSampled - 1) / kSampled);
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = area(tree_.slots[kSampled * i].box());
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(areas.size()));
    if (rank >= areas.size()) return -1.0F;
    const auto place = areas.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(areas.begin(), place, areas.end(), std::greater<>());
    return *place;
  }

  [[nodiscard]] Move find_best(std::uint32_t from, std::vector<Pending>& stack) const {
    Move best{from, from, 0.0F};
    const Box4 box = tree_.slots[from].box();
    std::uint32_t current = from;
    // Taking the slot out does away with the box around its node, and boxes further up may shrink to what remains.
    float saved = area(tree_.slots[tree_.parent_slot[from / 2]].box());
    Box4 remaining = Box4::empty();
    for (;;) {
      const std::uint32_t sibling = current ^ 1U;
      search_subtree({saved, sibling}, box, best, stack);
      const std::uint32_t above = tree_.parent_slot[current / 2];
      if (above == SlotTree::kNone) return best;
      remaining.grow(tree_.slots[sibling].box());
      if (current != from) saved += area(tree_.slots[above].box()) - area(remaining);
      current = above;
    }
  }

  // Looks for a better place than `best` at and below a slot.
  void search_subtree(const Pending& root, const Box4& box, Move& best, std::vector<Pending>& stack) const {
    const float box_area = area(box);
    stack.push_back(root);
    while (!stack.empty()) {
      const Pending top = stack.back();
      stack.pop_back();
      // The joined box is at least as large as what is put in.
      if (top.gain - box_area <= best.gain) continue;
      const SlotTree::Slot& slot = tree_.slots[top.slot];
      const Box4 slot_box = slot.box();
      Box4 joined = slot_box;
      joined.grow(box);
      const float gain = top.gain - area(joined);
      if (gain > best.gain) {
        best.to = top.slot;
        best.gain = gain;
      }
      const Bvh2Node::Child link = slot.link();
      if (link.count > 0) continue;
      // Joined further down, this box grows as well.
      const float below = gain + area(slot_box);
      if (below - box_area <= best.gain) continue;
      stack.push_back({below, 2 * link.first});
      stack.push_back({below, 2 * link.first + 1});
    }
  }

  // Makes a move unless an earlier one of the round has changed what it rests on.
  void apply(const Move& move) {
    const std::uint32_t node = move.from / 2;
    const std::uint32_t above = tree_.parent_slot[node];
    if (touched_[node] != 0 || touched_[above / 2] != 0 || touched_[move.to / 2] != 0 || move.to / 2 == node) return;
    // The target may have been moved into what is to be moved.
    for (std::uint32_t slot = move.to; slot != SlotTree::kNone; slot = tree_.parent_slot[slot / 2])
      if (slot == move.from) return;
    touched_[node] = touched_[above / 2] = touched_[move.to / 2] = 1;

    const SlotTree::Slot moved = tree_.slots[move.from];
    place(above, tree_.slots[move.from ^ 1U]);
    const SlotTree::Slot target = tree_.slots[move.to];
    place(2 * node, target);
    place(2 * node + 1, moved);
    Box4 joined = target.box();
    joined.grow(moved.box());
    tree_.slots[move.to].set(joined, {node, 0});
    tree_.parent_slot[node] = move.to;
    refit_above(above / 2);
    refit_above(move.to / 2);
  }

  void place(std::uint32_t slot, const SlotTree::Slot& content) {
    tree_.slots[slot] = content;
    const Bvh2Node::Child link = content.link();
    if (link.count == 0) tree_.parent_slot[link.first] = slot;
  }

  void refit_above(std::uint32_t node) {
    for (std::uint32_t slot = tree_.parent_slot[node]; slot != SlotTree::kNone; slot = tree_.parent_slot[slot / 2]) {
      const std::uint32_t below = tree_.slots[slot].link().first;
      Box4 box = tree_.slots[2 * below].box();
      box.grow(tree_.slots[2 * below + 1].box());
      const Box4 old = tree_.slots[slot].box();
      if (first_three_lanes((box.lower == old.lower) & (box.upper == old.upper)) == 7) return;
      tree_.slots[slot].set_box(box);
    }
  }

  SlotTree tree_;
  float scale_;
  std::vector<std::uint8_t> touched_;
};

}  // namespace

Bvh2 optimize_by_reinsertion(const Bvh2& bvh, const ReinsertionSettings& settings) {
  if (bvh.nodes.size() < 2) return bvh;
  Reinserter reinserter(bvh);
  const double before = reinserter.total_area();
  double area = before;
  for (std::uint32_t round = 0; round < settings.rounds; ++round) {
    if (settings.largest > 0.0) {
      reinserter.run_round_of_largest(settings.largest);
    } else {
      reinserter.run_round(round % settings.stride, settings.stride);
      if ((round + 1) % settings.stride != 0) continue;
    }
    const double now = reinserter.total_area();
    if (!(area - now > settings.least_gain * area)) break;
    area = now;
  }
  // A gain was true before the moves ahead of it in its round; all in all they could cost more than they save.
  if (reinserter.total_area() > before) return SlotTree(bvh).to_bvh2();
  return reinserter.tree().to_bvh2();
}

}  // namespace grove
