#pragma once

#include <memory>
#include <span>
#include <string>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::bench {

/// Something that builds a structure over a mesh and traces rays at it, one call a ray.
class Contender {
 public:
  virtual ~Contender() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// Builds anew, with `threads` threads, letting go of what was built before. Returns seconds.
  virtual double build(int threads) = 0;
  /// Lets go of what was built.
  virtual void release() = 0;
  /// Closest hits in the calling thread; `primitive` counts over the whole mesh.
  virtual void intersect(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
  /// Any hits in the calling thread.
  virtual void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results) const = 0;
};

[[nodiscard]] std::unique_ptr<Contender> make_grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec);
/// The qualities that Embree builds in: along a Morton curve, by binned splits, with spatial splits.
enum class EmbreeQuality { low, medium, high };

/// Embree 3 with the robust flag.
[[nodiscard]] std::unique_ptr<Contender> make_embree(std::shared_ptr<const TriangleMesh> mesh,
                                                     EmbreeQuality quality = EmbreeQuality::medium);

}  // namespace grove::bench
