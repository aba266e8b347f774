#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "grove/build/quality/structure_quality.h"
#include "grove/geometry/traceable.h"
#include "grove/registry/update.h"
#include "grove/traverse/traversal_record.h"

namespace grove {

/// What a built structure is made of. The names are those of the JSON of `grove inspect`.
struct StructureStatistics {
  std::uint64_t primitives = 0;
  std::uint64_t references = 0;  ///< entries in leaves; more than primitives where splits duplicate
  std::uint64_t nodes = 0;       ///< interior nodes and leaves
  std::uint64_t leaves = 0;
  std::uint32_t depth = 0;     ///< edges from the root to the deepest leaf; 0 for a single leaf
  std::uint64_t bytes = 0;     ///< kept for tracing, without the geometry itself
  double build_seconds = 0.0;  ///< wall clock
  double expected_cost = 0.0;  ///< surface-area cost of tracing one ray that meets the root (see build/cost_model.h)
  /// leaf_sizes[n] is the number of leaves with n references; the last entry counts all larger ones as well.
  std::vector<std::uint64_t> leaf_sizes;
  std::uint32_t largest_leaf = 0;  ///< references
  /// depths[d] is the number of leaves at depth d.
  std::vector<std::uint64_t> depths;
};

/// One node, for drawing.
struct NodeView {
  Box box;
  std::uint32_t depth = 0;
  bool is_leaf = false;
  std::uint32_t reference_count = 0;  ///< leaves only
  /// What TraversalStep calls it: different for all interior nodes, and for all leaves with references.
  std::uint32_t number = 0;
  /// Interior nodes that are cells: bit a is set where the cell is cut across axis a, at planes[a].
  std::uint8_t cut_axes = 0;
  Vec3 planes{0.0F};
};

/// A built structure over one geometry, its type erased: one virtual call a batch, none a node. Any number of threads may trace it;
/// it changes only in `update`. Made by `build` (registry/registry.h).
class Accelerator : public Traceable {
 public:
  /// The canonical spec: family and the keys that differ from their defaults.
  [[nodiscard]] virtual const std::string& spec() const = 0;
  /// Counted at the first call after building or updating, O(nodes); the reference holds until the next update.
  [[nodiscard]] virtual const StructureStatistics& statistics() const = 0;
  /// Measures how good a hierarchy is, beyond its expected cost; figures that make no sense for the structure or the geometry are missing. This is
  /// not done when building, as it takes about as long: half a second for a million triangles on two threads, and some 80 bytes a primitive for a while.
  /// Parallel in the caller's oneTBB arena; the same for any number of threads.
  [[nodiscard]] virtual StructureQuality measure_quality() const = 0;
  /// Calls `visit` for each node, parents before children.
  virtual void visit_nodes(const std::function<void(const NodeView&)>& visit) const = 0;

  /// Follows the geometry after it has changed, so that hits are again those of a structure built anew, and says how. Primitives may have moved
  /// (TriangleMesh::move_vertices and the like), been added behind the others (extend_last_part, add_part, add_instance), and been removed, which
  /// is to say have become unhittable (remove_triangle and the like); the numbers of all others stay, so `size` never falls. Telling which did
  /// (settings.changed) lets structures with local updates look at those alone. Where a form has no refit, or what can be hit is not what was
  /// there, it is rebuilt. Throws InputError, and changes nothing, for a number in settings.changed that no primitive has, for 2^31
  /// primitives or more, and where the geometry has become smaller. Must not run while rays are traced. Runs in parallel in the caller's oneTBB
  /// arena; the result does not depend on the number of threads.
  virtual UpdateReport update(const UpdateSettings& settings) = 0;

  /// Closest hits: hits[i] answers rays[i]. The spans must be of equal length. Runs in the calling thread; split the batch to use more.
  /// When `counts` is not empty it must be as long, and counts[i] is set to what ray i did.
  virtual void intersect(std::span<const Ray> rays, std::span<Hit> hits, std::span<TraversalCounts> counts = {}) const = 0;

  /// Any hits: occluded[i] becomes 1 where something is hit within [t_min, t_max] of rays[i], else 0. Otherwise as `intersect`.
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded, std::span<TraversalCounts> counts = {}) const = 0;

  /// The closest hits, and whether there are any, among those that `filter` accepts, which is told rays by their numbers in `rays`. Otherwise as without it.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits, const BatchHitFilter& filter) const { closest_hits(rays, hits, filter); }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded, const BatchHitFilter& filter) const {
    any_hits(rays, occluded, filter);
  }

  using Traceable::any_hits;
  using Traceable::closest_hits;
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const final { intersect(rays, hits); }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> results) const final { occluded(rays, results); }

  /// The closest hit as closest_hit finds it, and in `record` each step of the way there; what it held is lost. Several times slower. The walk of
  /// `fast` that is recorded is the plain one: its kernels find the same and may step through a node more or less.
  [[nodiscard]] virtual Hit record_steps(const Ray& ray, TraversalRecord& record) const = 0;

  /// A batch of one.
  [[nodiscard]] Hit intersect(const Ray& ray) const { return closest_hit(ray, nullptr); }
  [[nodiscard]] bool occluded(const Ray& ray) const { return any_hit(ray, nullptr); }
};

}  // namespace grove
