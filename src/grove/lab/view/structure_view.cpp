#include "grove/lab/view/structure_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "grove/base/error.h"
#include "grove/lab/batch.h"
#include "grove/lab/comparison_report.h"
#include "grove/lab/text_table.h"
#include "grove/lab/utc_date.h"
#include "grove/lab/view/packed_bytes.h"
#include "grove/lab/view/scene_triangles.h"
#include "grove/lab/view/tested_primitives.h"

namespace grove {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostTriangles = 120'000;
// Of all structures together, and of one.
constexpr std::size_t kMostNodes = 120'000;
constexpr std::size_t kMostNodesOfOne = 60'000;
constexpr std::size_t kMostSteps = 1'500'000;

Json vector_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json box_json(const Box& box) {
  return {{"lower", vector_json(box.lower)}, {"upper", vector_json(box.upper)}};
}

Json camera_json(const Camera& camera) {
  constexpr float kAspect = static_cast<float>(PictureRays::kWidth) / static_cast<float>(PictureRays::kHeight);
  // The picture is wider than high, so the smaller extent is the vertical one.
  float vertical = camera.field_of_view;
  if (camera.axis == FieldOfViewAxis::horizontal) vertical = 2.0F * std::atan(std::tan(0.5F * vertical) / kAspect);
  const Mat4& m = camera.camera_to_world;
  return {{"eye", vector_json(Vec3(m[3]))},
          {"forward", vector_json(-glm::normalize(Vec3(m[2])))},
          {"up", vector_json(glm::normalize(Vec3(m[1])))},
          {"vertical_field_of_view", vertical}};
}

Json triangles_json(const SceneTriangles& triangles) {
  PackedBytes vertices;
  for (const SceneTriangles::Point& vertex : triangles.vertices)
    for (const std::uint16_t step : vertex) vertices.add_u16(step);
  PackedBytes indices;
  std::int64_t last = 0;
  for (const auto& triangle : triangles.triangles) {
    for (const std::uint32_t index : triangle) {
      indices.add_signed(std::int64_t{index} - last);
      last = index;
    }
  }
  return {{"total", triangles.total},   {"shown", triangles.triangles.size()}, {"grid", triangles.grid},
          {"one_in", triangles.one_in}, {"vertices", vertices.base64()},       {"indices", indices.base64()}};
}

/// One stream a column: the same kind of number repeats.
Json nodes_json(const ViewTree& tree, const NodeSelection& selection, const Box& bounds) {
  const Quantiser quantiser(bounds);
  PackedBytes parents;
  PackedBytes boxes;
  PackedBytes kinds;
  PackedBytes children;
  PackedBytes references;
  PackedBytes visits;
  PackedBytes tests;
  PackedBytes planes;
  for (std::uint32_t i = 0; i < selection.places.size(); ++i) {
    const ViewNode& node = tree.nodes()[selection.places[i]];
    parents.add_varint(node.parent == ViewNode::kNone ? 0 : i - selection.index[node.parent]);
    quantiser.add_box(boxes, node.box);
    kinds.add_byte(static_cast<std::uint8_t>((node.is_leaf ? 8U : 0U) | node.cut_axes));
    children.add_varint(node.child_count);
    references.add_varint(node.references);
    visits.add_varint(node.visits);
    tests.add_varint(node.tests);
    for (int axis = 0; axis < 3; ++axis)
      if ((node.cut_axes >> axis & 1U) != 0) planes.add_u16(quantiser.nearest(axis, node.planes[axis]));
  }
  return {{"count", selection.places.size()}, {"total", tree.nodes().size()},      {"complete_depth", selection.complete_depth},
          {"parents", parents.base64()},      {"boxes", boxes.base64()},           {"kinds", kinds.base64()},
          {"children", children.base64()},    {"references", references.base64()}, {"visits", visits.base64()},
          {"tests", tests.base64()},          {"planes", planes.base64()}};
}

Json picture_json(const StepPicture& picture) {
  PackedBytes steps;
  for (const std::uint32_t count : picture.steps) steps.add_varint(count);
  return {{"width", picture.width}, {"height", picture.height}, {"steps", steps.base64()}};
}

/// Each ray: how many steps, and one byte, 1 where there were more. A step is a number whose lowest three bits tell its kind and the others how far
/// its node is from the last one's, or its primitive from the last one's.
std::string traces_base64(const std::vector<RecordedRay>& recorded, std::span<const std::uint32_t> rays, TestedPrimitives& tested) {
  constexpr std::uint64_t kTest = 4;
  constexpr std::uint64_t kClosestYet = 5;
  PackedBytes bytes;
  for (const std::uint32_t number : rays) {
    const RecordedRay& ray = recorded[number];
    bytes.add_varint(ray.steps.size());
    bytes.add_byte(ray.is_cut ? 1 : 0);
    std::int64_t last_node = 0;
    std::int64_t last_test = 0;
    for (const PlacedStep& step : ray.steps) {
      if (step.kind == TraversalStep::Kind::test) {
        const std::int64_t place = tested.place(step.place, step.instance);
        bytes.add_varint(PackedBytes::zigzag(place - last_test) << 3U | (step.is_closest_yet ? kClosestYet : kTest));
        if (step.is_closest_yet) bytes.add_float(step.distance);
        last_test = place;
        continue;
      }
      bytes.add_varint(PackedBytes::zigzag(std::int64_t{step.place} - last_node) << 3U | static_cast<std::uint64_t>(step.kind));
      if (step.kind == TraversalStep::Kind::gap) bytes.add_byte(step.octant);
      last_node = step.place;
    }
  }
  return bytes.base64();
}

}  // namespace

StructureView::StructureView(const Scene& scene, const Camera& camera, std::size_t structure_count) : scene_(scene), picture_(camera) {
  limits_.most_nodes = std::min(kMostNodesOfOne, kMostNodes / structure_count);
  limits_.most_steps = kMostSteps / structure_count;
}

void StructureView::add(const SceneAccelerator& accelerator, Json figures) {
  const Accelerator& top = accelerator.top();
  StructureSample sample = sample_structure(scene_, accelerator, picture_);
  if (sample.tree.nodes().empty())
    throw UsageError(fmt::format("--html: structure '{}' has no nodes to show; name another", accelerator.spec()));
  if (shades_.empty()) {
    std::vector<Hit> hits(picture_.rays().size());
    trace(top, Query::closest, picture_.rays(), hits);
    shades_ = shade_picture(scene_, picture_.rays(), hits);
  }

  const NodeSelection selection = select_nodes(sample.tree, sample.recorded, limits_);
  const Box bounds = sample.tree.nodes().front().box;
  Json& json = structures_.emplace_back();
  json["structure"] = accelerator.spec();
  json["figures"] = std::move(figures);
  json["has_top_level"] = accelerator.has_top_level();
  json["objects_shown"] = accelerator.has_top_level() && sample.tree.is_whole();
  json["bounds"] = box_json(bounds);
  json["nodes"] = nodes_json(sample.tree, selection, bounds);
  json["sampled_rays"] = sample.picture.steps.size();
  json["picture"] = picture_json(sample.picture);

  for (RecordedRay& ray : sample.recorded) {
    for (PlacedStep& step : ray.steps)
      if (step.kind != TraversalStep::Kind::test && step.place != ViewNode::kNone) step.place = selection.index[step.place];
  }
  recorded_.push_back(std::move(sample.recorded));
  strides_.push_back(selection.stride);
}

std::uint32_t StructureView::stride() const {
  return strides_.empty() ? PictureRays::kLeastStride : *std::ranges::max_element(strides_);
}

Json StructureView::json(std::string_view source, const std::string& command) const {
  const std::uint32_t common_stride = stride();
  const std::vector<std::uint32_t> rays = recorded_of_stride(common_stride);
  TestedPrimitives tested;
  Json structures = Json::array();
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    Json& structure = structures.emplace_back(structures_[i]);
    structure["traces"] = traces_base64(recorded_[i], rays, tested);
  }
  const SceneTriangles triangles = triangles_of(scene_, kMostTriangles);

  PackedBytes lines;
  PackedBytes distances;
  const std::vector<std::uint32_t> pixels = PictureRays::pixels(common_stride);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = picture_.rays()[pixels[i]];
    for (int axis = 0; axis < 3; ++axis) lines.add_float(ray.origin[axis]);
    for (int axis = 0; axis < 3; ++axis) lines.add_float(ray.direction[axis]);
    distances.add_float(recorded_.empty() ? 0.0F : recorded_.front()[rays[i]].hit.t);
  }
  PackedBytes shades;
  for (const std::uint8_t shade : shades_) shades.add_byte(shade);

  Json json;
  json["format"] = "grove-inspect";
  json["version"] = 1;
  json["machine"] = machine_json(describe_machine());
  json["command"] = command;
  json["date"] = utc_date();
  json["scene"] = source;
  json["primitives"] = scene_.primitive_count();
  json["bounds"] = box_json(triangles.bounds);
  json["camera"] = camera_json(picture_.camera());
  json["triangles"] = triangles_json(triangles);
  json["picture"] = {{"width", PictureRays::kWidth}, {"height", PictureRays::kHeight}, {"shades", shades.base64()}};
  json["rays"] = {{"stride", common_stride},
                  {"columns", PictureRays::columns(common_stride)},
                  {"rows", PictureRays::rows(common_stride)},
                  {"lines", lines.base64()},
                  {"distances", distances.base64()}};
  json["tested"] = tested.json(scene_, triangles.bounds);
  json["structures"] = std::move(structures);
  return json;
}

}  // namespace grove
