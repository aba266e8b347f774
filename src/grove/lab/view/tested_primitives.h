#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <unordered_map>
#include <vector>

#include "grove/scene/scene.h"

namespace grove {

/// The primitives that recorded rays are tested against, each once, in the order in which they are first asked for.
class TestedPrimitives {
 public:
  /// The place of a primitive: of the top structure where `instance` is kInvalidId (a triangle or sphere of the only object, or an instance), else of an
  /// instance's object.
  std::uint32_t place(std::uint32_t primitive, std::uint32_t instance);

  /// {count, kinds, ids, instances, shapes}. Of kind 0, triangles, shapes are three corners, of 1, spheres, and 2, instances, a box, in steps of the
  /// scene's bounds.
  [[nodiscard]] nlohmann::ordered_json json(const Scene& scene, const Box& bounds) const;

 private:
  struct Primitive {
    std::uint32_t number;
    std::uint32_t instance;
  };

  std::vector<Primitive> primitives_;
  std::unordered_map<std::uint64_t, std::uint32_t> places_;
};

}  // namespace grove
