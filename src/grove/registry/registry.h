#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "grove/geometry/instance_set.h"
#include "grove/geometry/sphere_set.h"
#include "grove/geometry/triangle_mesh.h"
#include "grove/geometry/user_geometry.h"
#include "grove/registry/accelerator.h"

namespace grove {

/// One of the things that a structure can be built over. The structure shares ownership.
using GeometryPointer = std::variant<std::shared_ptr<const TriangleMesh>, std::shared_ptr<const SphereSet>,
                                     std::shared_ptr<const InstanceSet>, std::shared_ptr<const UserGeometry>>;

/// A key of a family's spec: either `values` lists what is allowed (the default first), or it is a whole number in [minimum, maximum].
struct SpecKey {
  std::string_view name;
  std::vector<std::string_view> values;
  int minimum = 0;
  int maximum = 0;
  int default_number = 0;
  std::string_view summary;

  [[nodiscard]] bool is_number() const { return values.empty(); }
  [[nodiscard]] std::string default_value() const { return is_number() ? std::to_string(default_number) : std::string(values.front()); }
};

/// A name of its own for a value of one key of a family.
struct ShortSpec {
  std::string_view name;
  std::string_view key;
  std::string_view value;
};

/// A family of structures: what `grove structures` lists.
struct StructureFamily {
  std::string_view name;
  std::string_view summary;
  std::vector<SpecKey> keys;
  std::vector<ShortSpec> shorts = {};
};

/// All registered families, in the order they are listed.
[[nodiscard]] std::span<const StructureFamily> structure_families();

/// Specs that the tests and `grove compare` run by default: one per family and heuristic.
[[nodiscard]] std::span<const std::string_view> representative_specs();

/// The spec that is used where none is named.
inline constexpr std::string_view kDefaultSpec = "bvh";

/// Checks `spec` ("family" or "family:key=value,key=value") and returns its canonical form.
/// Throws UsageError that lists what is allowed.
[[nodiscard]] std::string canonical_spec(std::string_view spec);

/// Whether hits of the structure may differ from those of all others by rounding, as those of `fast:triangles=fast` do. Throws as canonical_spec.
[[nodiscard]] bool rounds_hits(std::string_view spec);

/// Builds the structure that `spec` names over `geometry`, in parallel in the caller's oneTBB arena; the result does not depend on the
/// number of threads. Throws UsageError for a bad spec and InputError for 2^31 primitives or more.
[[nodiscard]] std::unique_ptr<Accelerator> build(GeometryPointer geometry, std::string_view spec = kDefaultSpec);

/// The same, for a mesh that is given away.
[[nodiscard]] std::unique_ptr<Accelerator> build(TriangleMesh mesh, std::string_view spec = kDefaultSpec);

}  // namespace grove
