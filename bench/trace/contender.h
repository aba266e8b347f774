#pragma once

#include <memory>
#include <span>
#include <string>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::bench {

/// Something that builds a structure over a mesh and traces rays at it.
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

/// How many rays a contender gets in one call.
enum class Calls { one_ray, all_rays };

[[nodiscard]] std::unique_ptr<Contender> make_grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec,
                                                    Calls calls = Calls::one_ray);

/// The qualities that Embree builds in: along a Morton curve, by binned splits, with spatial splits.
enum class EmbreeQuality { low, medium, high };

struct EmbreeSettings {
  EmbreeQuality quality = EmbreeQuality::medium;
  /// The flag for watertight tests. It rules out splitting triangles, which makes high quality what it is.
  bool robust = true;
  /// As Embree's device configuration names it ("avx2"); empty for its own choice.
  std::string isa;
};

/// Embree 3, one ray a call.
[[nodiscard]] std::unique_ptr<Contender> make_embree(std::shared_ptr<const TriangleMesh> mesh, EmbreeSettings settings = {});

}  // namespace grove::bench
