#pragma once

// Octrees beside each other on the same primitives and rays: what they are made of, what rays do in them, and how long that takes. Settings that specs do not
// have are reached here, so that octree-R can be given as many leaves as an octree.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "grove/build/octree/octree_settings.h"
#include "grove/registry/registry.h"
#include "grove/traverse/traceable_octree.h"

namespace grove {

struct OctreeContender {
  std::string name;
  OctreeSettings settings;
  OctreeWalk walk = OctreeWalk::top_down;
  UseMailbox mailbox = UseMailbox::yes;
  /// Whether neighbours are found by stored links (lab/octree_links.h); only with OctreeStore::leaf. `walk` says nothing then.
  bool has_links = false;
};

/// Counts and times are for an average ray.
struct OctreeTrial {
  std::string name;
  std::uint64_t nodes = 0;  ///< that cut a cell
  std::uint64_t leaves = 0;
  std::uint64_t references = 0;
  std::uint64_t bytes = 0;  ///< of nodes, leaves, references and links
  double build_seconds = 0.0;
  double nodes_visited = 0.0;
  double leaves_entered = 0.0;
  double tests = 0.0;
  std::vector<double> nanoseconds;  ///< by round
};

/// Builds all contenders over one geometry and traces closest hits of all rays in each round, one contender after the other, in the calling thread. All
/// must hit the same primitives, which is checked.
[[nodiscard]] std::vector<OctreeTrial> try_octrees(const GeometryPointer& geometry, std::span<const OctreeContender> contenders,
                                                   std::span<const Ray> rays, unsigned rounds);

/// How many leaves an octree has.
[[nodiscard]] std::uint64_t count_octree_leaves(const GeometryPointer& geometry, const OctreeSettings& settings);

/// Settings of octree-R with such a time of a step that it has as nearly `leaves` leaves as `builds` trials can find; fewer where it has not as many at no cost.
[[nodiscard]] OctreeSettings match_leaves(const GeometryPointer& geometry, OctreeSettings settings, std::uint64_t leaves, int builds);

/// Seconds by round of bringing an octree up to date, and of building it anew, in turn; without what a structure keeps for testing primitives.
struct OctreeUpdateTrial {
  std::vector<double> update_seconds;
  std::vector<double> build_seconds;
};

/// An octree over `before` is made to follow to `after`, where primitives `moved` are elsewhere; both of one kind of geometry. Throws InputError where it takes a new
/// tree (update_octree).
[[nodiscard]] OctreeUpdateTrial try_octree_update(const GeometryPointer& before, const GeometryPointer& after,
                                                  std::span<const std::uint32_t> moved, const OctreeSettings& settings, unsigned rounds);

/// Equation 5 of the review with what belongs to a ray whatever it does: nanoseconds = per_ray + nodes visited * per_voxel + tests * per_test.
struct Equation5 {
  double per_ray = 0.0;
  double per_voxel = 0.0;
  double per_test = 0.0;
  double r_squared = 0.0;  ///< the share of the variance of the times that is explained

  [[nodiscard]] double predict(const OctreeTrial& trial) const {
    return per_ray + trial.nodes_visited * per_voxel + trial.tests * per_test;
  }
};

/// Least squares over trials, by the medians of their times; at least three that differ in both counts.
[[nodiscard]] Equation5 fit_equation_5(std::span<const OctreeTrial> trials);

}  // namespace grove
