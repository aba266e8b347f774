#include "grove/lab/view/tested_primitives.h"

#include <nlohmann/json.hpp>
#include <optional>

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

std::uint32_t TestedPrimitives::place(std::uint32_t primitive) {
  const auto next = static_cast<std::uint32_t>(primitives_.size());
  const auto [found, is_new] = places_.try_emplace(primitive, next);
  if (is_new) primitives_.push_back(primitive);
  return found->second;
}

nlohmann::ordered_json TestedPrimitives::json(const Scene& scene, const Box& bounds) const {
  const Quantiser quantiser(bounds);
  PackedBytes ids;
  PackedBytes shapes;
  std::int64_t last = 0;
  for (const std::uint32_t primitive : primitives_) {
    ids.add_signed(std::int64_t{primitive} - last);
    last = primitive;
  }
  std::string kind = "instance";
  if (has_top_level(scene)) {
    std::vector<std::optional<Box>> objects(scene.objects.size());
    for (const std::uint32_t primitive : primitives_) {
      const Instance& instance = scene.instances[primitive];
      std::optional<Box>& box = objects[instance.object];
      if (!box) box = object_bounds(scene.objects[instance.object]);
      quantiser.add_box(shapes, instance.object_to_world.box(*box));
    }
  } else if (const auto* const mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&scene.objects.front().geometry)) {
    kind = "triangle";
    for (const std::uint32_t primitive : primitives_) {
      const Triangle& triangle = (*mesh)->triangles()[primitive];
      for (int corner = 0; corner < 3; ++corner) quantiser.add_point(shapes, (*mesh)->vertices()[triangle[corner]]);
    }
  } else {
    kind = "sphere";
    const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(scene.objects.front().geometry);
    for (const std::uint32_t primitive : primitives_) quantiser.add_box(shapes, spheres.bounds(primitive));
  }
  return {{"kind", kind}, {"count", primitives_.size()}, {"ids", ids.base64()}, {"shapes", shapes.base64()}};
}

}  // namespace grove
