#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"
#include "grove/geometry/triangle_mesh.h"

namespace grove::bench::rivals {

/// A structure over a mesh that is asked about rays in one or more ways, each with its number of rays a call.
class Entrant {
 public:
  struct Traits {
    std::string name;
    bool is_rival = false;   ///< not Grove's
    bool is_robust = false;  ///< promises not to miss between neighbouring triangles
    bool is_exact = false;   ///< promises Grove's hits to the bit
  };

  Entrant() = default;
  virtual ~Entrant() = default;
  Entrant(const Entrant&) = delete;
  Entrant& operator=(const Entrant&) = delete;

  [[nodiscard]] virtual const Traits& traits() const = 0;
  /// Rays a call, ascending.
  [[nodiscard]] virtual std::span<const std::size_t> call_sizes() const = 0;

  /// Builds anew in the caller's oneTBB arena, letting go of what was built before. Returns seconds.
  virtual double build() = 0;
  /// Kept for tracing, without the mesh itself.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;

  /// Closest hits in the calling thread, with one of `call_sizes` rays a call; `primitive` counts over the whole mesh. Coherent rays start at one place and
  /// go in about one direction; whoever has a use for knowing that is told.
  virtual void intersect(std::size_t call_size, bool is_coherent, std::span<const Ray> rays, std::span<Hit> hits) const = 0;
  /// Any hits: 1 where there is one, else 0.
  virtual void occluded(std::size_t call_size, std::span<const Ray> rays, std::span<std::uint8_t> results) const = 0;
};

/// A structure of Grove's. `call_sizes` are those it is to be asked with; 1 is a call for a single ray.
[[nodiscard]] std::unique_ptr<Entrant> make_grove(std::shared_ptr<const TriangleMesh> mesh, std::string spec,
                                                  std::vector<std::size_t> call_sizes);

/// How Embree is set up.
struct EmbreeSettings {
  enum class Quality { medium, high };
  Quality quality = Quality::medium;
  bool is_robust = false;  ///< its flag for watertight tests
  /// As its device configuration names it ("avx2"); empty for its own choice.
  std::string isa;
};

/// Embree 3: rtcIntersect1, 8 and 16. Packets are filled from rays and hits are read from them within each call: whoever has rays as Grove takes them must do so.
[[nodiscard]] std::unique_ptr<Entrant> make_embree(std::shared_ptr<const TriangleMesh> mesh, const EmbreeSettings& settings);

}  // namespace grove::bench::rivals
