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
  /// The place of a primitive of the top structure: a triangle or sphere of the only object, or an instance.
  std::uint32_t place(std::uint32_t primitive);

  /// {kind, ids, shapes}: of kind "triangle" shapes are three corners, of "sphere" and "instance" a box, in steps of the scene's bounds.
  [[nodiscard]] nlohmann::ordered_json json(const Scene& scene, const Box& bounds) const;

 private:
  std::vector<std::uint32_t> primitives_;
  std::unordered_map<std::uint32_t, std::uint32_t> places_;
};

}  // namespace grove
