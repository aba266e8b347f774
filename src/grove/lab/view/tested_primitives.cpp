#include "grove/lab/view/tested_primitives.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "grove/geometry/hit.h"
#include "grove/lab/view/packed_bytes.h"

namespace grove {
namespace {

bool has_top_level(const Scene& scene) {
  return scene.objects.size() != 1 || scene.instances.size() != 1 || !scene.instances.front().object_to_world.is_identity();
}

Box object_bounds(const Object& object) {
  Box box;
  std::visit(
      [&](const auto& set) {
        for (std::size_t i = 0; i < set->size(); ++i) box.grow(set->bounds(i));
      },
      object.geometry);
  return box;
}

}  // namespace

std::uint32_t TestedPrimitives::place(std::uint32_t primitive, std::uint32_t instance) {
  const auto next = static_cast<std::uint32_t>(primitives_.size());
  const auto [found, is_new] = places_.try_emplace(std::uint64_t{instance} << 32U | primitive, next);
  if (is_new) primitives_.push_back({primitive, instance});
  return found->second;
}

nlohmann::ordered_json TestedPrimitives::json(const Scene& scene, const Box& bounds) const {
  constexpr std::uint8_t kTriangle = 0;
  constexpr std::uint8_t kSphere = 1;
  constexpr std::uint8_t kInstance = 2;
  const Quantiser quantiser(bounds);
  const bool is_nested = has_top_level(scene);
  std::vector<std::optional<Box>> objects(scene.objects.size());
  PackedBytes kinds;
  PackedBytes ids;
  PackedBytes instances;
  PackedBytes shapes;
  std::int64_t last = 0;
  for (const auto& [number, of_instance] : primitives_) {
    ids.add_signed(std::int64_t{number} - last);
    last = number;
    instances.add_varint(of_instance == kInvalidId ? 0 : std::uint64_t{of_instance} + 1);
    const bool is_instance = is_nested && of_instance == kInvalidId;
    const Instance& instance = is_instance ? scene.instances[number] : scene.instances[is_nested ? of_instance : 0];
    const Object& object = scene.objects[instance.object];
    if (is_instance) {
      std::optional<Box>& box = objects[instance.object];
      if (!box) box = object_bounds(object);
      kinds.add_byte(kInstance);
      quantiser.add_box(shapes, instance.object_to_world.box(*box));
    } else if (const auto* const mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
      kinds.add_byte(kTriangle);
      const Triangle& triangle = (*mesh)->triangles()[number];
      for (int corner = 0; corner < 3; ++corner)
        quantiser.add_point(shapes, instance.object_to_world.point((*mesh)->vertices()[triangle[corner]]));
    } else {
      kinds.add_byte(kSphere);
      const Box box = std::get<std::shared_ptr<SphereSet>>(object.geometry)->bounds(number);
      quantiser.add_box(shapes, instance.object_to_world.box(box));
    }
  }
  return {{"count", primitives_.size()},
          {"kinds", kinds.base64()},
          {"ids", ids.base64()},
          {"instances", instances.base64()},
          {"shapes", shapes.base64()}};
}

}  // namespace grove
