#include "grove/lab/view/structure_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "grove/base/error.h"
#include "grove/lab/batch.h"
#include "grove/lab/structure_report.h"
#include "grove/lab/view/packed_bytes.h"
#include "grove/lab/view/scene_triangles.h"
#include "grove/lab/workload.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

const std::vector<std::string> kSpecs{"bvh",    "bvh:arity=8",       "bvh:bounds=sphere",     "fast",
                                      "kdtree", "kdtree:walk=ropes", "octree:walk=neighbour", "octree:store=inner"};

std::vector<std::uint8_t> from_base64(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    word = word << 6U | static_cast<std::uint32_t>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(word >> bits & 0xffU));
  }
  return bytes;
}

std::vector<std::uint64_t> varints(const std::string& text) {
  std::vector<std::uint64_t> numbers;
  std::uint64_t number = 0;
  unsigned shift = 0;
  for (const std::uint8_t byte : from_base64(text)) {
    number |= std::uint64_t{byte & 0x7fU} << shift;
    shift += 7;
    if ((byte & 0x80U) != 0) continue;
    numbers.push_back(number);
    number = 0;
    shift = 0;
  }
  return numbers;
}

TEST(PackedBytes, WritesNumbersAsBase64) {
  PackedBytes bytes;
  EXPECT_EQ(bytes.base64(), "");
  bytes.add_byte('M');
  EXPECT_EQ(bytes.base64(), "TQ==");
  bytes.add_u16(0x6e61);
  EXPECT_EQ(bytes.base64(), "TWFu");
  for (const std::uint64_t number : {0ULL, 127ULL, 128ULL, 300ULL, ~0ULL}) {
    PackedBytes varint;
    varint.add_varint(number);
    EXPECT_EQ(varints(varint.base64()), std::vector<std::uint64_t>{number});
  }
  EXPECT_EQ(PackedBytes::zigzag(0), 0U);
  EXPECT_EQ(PackedBytes::zigzag(-1), 1U);
  EXPECT_EQ(PackedBytes::zigzag(1), 2U);
}

TEST(Quantiser, OnlyGrowsBoxes) {
  const Quantiser quantiser(Box{Vec3(-1.0F), Vec3(2.0F)});
  EXPECT_EQ(quantiser.nearest(0, -1.0F), 0);
  EXPECT_EQ(quantiser.nearest(0, 2.0F), 65535);
  EXPECT_EQ(quantiser.nearest(1, 100.0F), 65535);
  EXPECT_EQ(quantiser.nearest(2, std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_LT(quantiser.below(0, 0.1F), quantiser.above(0, 0.1F));
}

/// What all rays of a picture do.
TraversalCounts count_all(const Accelerator& accelerator, const PictureRays& picture) {
  TraversalCounts counts;
  TraversalRecord record;
  for (const Ray& ray : picture.rays()) {
    if (accelerator.spec() != "fast") {
      static_cast<void>(accelerator.closest_hit(ray, &counts));
      continue;
    }
    // Its kernels may come to children in another order than the plain walk, which is recorded.
    static_cast<void>(accelerator.record_steps(ray, record));
    for (const TraversalStep& step : record.steps) {
      counts.nodes_visited += step.kind == TraversalStep::Kind::node ? 1 : 0;
      counts.leaves_entered += step.kind == TraversalStep::Kind::leaf ? 1 : 0;
      counts.primitives_tested += step.kind == TraversalStep::Kind::test ? 1 : 0;
    }
  }
  return counts;
}

class StructureSamples : public ::testing::TestWithParam<std::string> {};

TEST_P(StructureSamples, AddUp) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, GetParam());
  const PictureRays picture(workload_camera(scene, ""));
  const StructureSample sample = sample_structure(scene, accelerator, picture);
  const std::span<const ViewNode> nodes = sample.tree.nodes();
  ASSERT_EQ(nodes.size(), accelerator.statistics().nodes);
  EXPECT_EQ(nodes.front().references, accelerator.statistics().references);
  EXPECT_EQ(std::ranges::count_if(nodes, &ViewNode::is_leaf), static_cast<std::ptrdiff_t>(accelerator.statistics().leaves));
  for (std::uint32_t i = 1; i < nodes.size(); ++i) {
    ASSERT_LT(nodes[i].parent, i);
    EXPECT_EQ(nodes[i].depth, nodes[nodes[i].parent].depth + 1);
  }

  // Visits and tests are all that rays do.
  const TraversalCounts counts = count_all(accelerator.top(), picture);
  EXPECT_EQ(nodes.front().tests, counts.primitives_tested);
  const std::uint64_t steps = std::accumulate(sample.picture.steps.begin(), sample.picture.steps.end(), std::uint64_t{0});
  EXPECT_EQ(steps, counts.nodes_visited + counts.primitives_tested);
  std::uint64_t leaf_visits = 0;
  for (const ViewNode& node : nodes) leaf_visits += node.is_leaf ? node.visits : 0;
  EXPECT_GE(leaf_visits, counts.leaves_entered);
}

TEST_P(StructureSamples, RecordTheSameHits) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, GetParam());
  const PictureRays picture(workload_camera(scene, ""));
  const StructureSample sample = sample_structure(scene, accelerator, picture);
  const std::vector<std::uint32_t> pixels = PictureRays::pixels(PictureRays::kLeastStride);
  ASSERT_EQ(sample.recorded.size(), pixels.size());
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Hit hit = accelerator.top().intersect(picture.rays()[pixels[i]]);
    ASSERT_TRUE(same_bits(hit, sample.recorded[i].hit));
    const auto& steps = sample.recorded[i].steps;
    const auto last = std::find_if(steps.rbegin(), steps.rend(), [](const PlacedStep& step) { return step.is_closest_yet; });
    EXPECT_EQ(last != steps.rend(), static_cast<bool>(hit));
    if (last == steps.rend()) continue;
    EXPECT_EQ(last->distance, hit.t);
    ++hit_count;
  }
  EXPECT_GT(hit_count, 100U);
}

TEST_P(StructureSamples, KeepWhatRecordedRaysComeTo) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, GetParam());
  const PictureRays picture(workload_camera(scene, ""));
  const StructureSample sample = sample_structure(scene, accelerator, picture);
  ViewLimits limits;
  limits.most_nodes = accelerator.statistics().nodes / 2;
  const NodeSelection selection = select_nodes(sample.tree, sample.recorded, limits);
  EXPECT_LT(selection.places.size(), sample.tree.nodes().size());
  EXPECT_TRUE(std::ranges::is_sorted(selection.places));
  for (const std::uint32_t ray : recorded_of_stride(selection.stride)) {
    for (const PlacedStep& step : sample.recorded[ray].steps)
      if (step.kind != TraversalStep::Kind::test) {
        ASSERT_NE(selection.index[step.place], ViewNode::kNone);
      }
  }
  for (std::uint32_t i = 0; i < sample.tree.nodes().size(); ++i) {
    const ViewNode& node = sample.tree.nodes()[i];
    if (node.depth <= selection.complete_depth) {
      EXPECT_NE(selection.index[i], ViewNode::kNone);
    }
    if (selection.index[i] != ViewNode::kNone && i > 0) {
      EXPECT_NE(selection.index[node.parent], ViewNode::kNone) << "cut off from the root";
    }
  }
  // With room for everything, everything is there.
  const NodeSelection all = select_nodes(sample.tree, sample.recorded, {});
  EXPECT_EQ(all.places.size(), sample.tree.nodes().size());
  EXPECT_EQ(all.stride, PictureRays::kLeastStride);
}

INSTANTIATE_TEST_SUITE_P(Specs, StructureSamples, ::testing::ValuesIn(kSpecs), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace_if(
      name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

TEST(StructureSample, TracesFewerRaysWhereTheyTakeManySteps) {
  const Scene scene = testing::small_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const PictureRays picture(workload_camera(scene, ""));
  const StructureSample sample = sample_structure(scene, accelerator, picture, 200'000);
  EXPECT_LT(sample.picture.width, PictureRays::kWidth);
  EXPECT_EQ(sample.picture.steps.size(), std::size_t{sample.picture.width} * sample.picture.height);
}

TEST(SceneTriangles, AreKeptWhereTheyFit) {
  const Scene scene = testing::instanced_scene();
  const SceneTriangles triangles = triangles_of(scene, 1000);
  EXPECT_EQ(triangles.total, scene.primitive_count());
  EXPECT_EQ(triangles.triangles.size(), scene.primitive_count());
  EXPECT_EQ(triangles.grid, 0U);
}

TEST(SceneTriangles, AreKeptOnceWhereTheyAreTheSame) {
  Scene scene = testing::small_scene();
  scene.instances.push_back(scene.instances.front());
  const SceneTriangles triangles = triangles_of(scene, 1000);
  EXPECT_EQ(triangles.total, scene.primitive_count());
  EXPECT_EQ(2 * triangles.triangles.size(), scene.primitive_count());
}

TEST(SceneTriangles, AreJoinedWhereTheyDoNot) {
  const Scene scene = testing::instanced_scene();
  const SceneTriangles triangles = triangles_of(scene, 100);
  EXPECT_LE(triangles.triangles.size(), 100U);
  EXPECT_GT(triangles.triangles.size(), 20U) << "the boxes around";
  EXPECT_GT(triangles.grid, 0U);
  for (const auto& triangle : triangles.triangles)
    for (const std::uint32_t index : triangle) ASSERT_LT(index, triangles.vertices.size());
}

TEST(StructureView, HoldsAllStructures) {
  const Scene scene = testing::small_scene();
  StructureView view(scene, workload_camera(scene, ""), 2);
  for (const char* const spec : {"bvh", "octree:walk=neighbour"}) {
    const SceneAccelerator accelerator(scene, spec);
    view.add(accelerator, structure_json(spec, accelerator.statistics(), 1));
  }
  const nlohmann::ordered_json json = view.json("small", "grove inspect");
  EXPECT_EQ(json.at("format"), "grove-inspect");
  EXPECT_EQ(json.at("version"), 1);
  ASSERT_EQ(json.at("structures").size(), 2U);
  for (const auto& structure : json.at("structures")) {
    const auto& nodes = structure.at("nodes");
    const auto count = nodes.at("count").get<std::size_t>();
    EXPECT_EQ(count, structure.at("figures").at("nodes").get<std::size_t>());
    EXPECT_EQ(varints(nodes.at("parents")).size(), count);
    EXPECT_EQ(from_base64(nodes.at("boxes")).size(), 12 * count);
    EXPECT_EQ(varints(nodes.at("references")).front(), structure.at("figures").at("references").get<std::size_t>());
    EXPECT_FALSE(structure.at("traces").get<std::string>().empty());
  }
  const auto& rays = json.at("rays");
  const auto ray_count = rays.at("columns").get<std::size_t>() * rays.at("rows").get<std::size_t>();
  EXPECT_EQ(from_base64(rays.at("lines")).size(), 24 * ray_count);
  EXPECT_EQ(from_base64(rays.at("distances")).size(), 4 * ray_count);
  const auto tested = json.at("tested").at("count").get<std::size_t>();
  EXPECT_GT(tested, 50U);
  EXPECT_EQ(from_base64(json.at("tested").at("kinds")), std::vector<std::uint8_t>(tested, 0));
  EXPECT_EQ(from_base64(json.at("tested").at("shapes")).size(), 18 * tested);
}

TEST_P(StructureSamples, GoIntoTheObjectsOfInstances) {
  const Scene scene = testing::instanced_scene();
  const SceneAccelerator accelerator(scene, GetParam());
  const PictureRays picture(workload_camera(scene, ""));
  const StructureSample sample = sample_structure(scene, accelerator, picture);
  ASSERT_TRUE(sample.tree.is_whole());
  // The object stands twice.
  const std::uint64_t object_nodes = accelerator.objects()[0]->statistics().nodes;
  EXPECT_EQ(sample.tree.nodes().size(), accelerator.top().statistics().nodes + 2 * object_nodes);
  const bool is_recorded_otherwise = accelerator.spec() == "fast";  // as above; here in the objects
  if (!is_recorded_otherwise) {
    EXPECT_EQ(sample.tree.nodes().front().tests, count_all(accelerator.top(), picture).primitives_tested);
  }

  const std::vector<std::uint32_t> pixels = PictureRays::pixels(PictureRays::kLeastStride);
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    TraversalCounts ray_counts;
    const Hit hit = accelerator.top().closest_hit(picture.rays()[pixels[i]], &ray_counts);
    ASSERT_TRUE(same_bits(hit, sample.recorded[i].hit));
    std::uint64_t tests = 0;
    float closest = std::numeric_limits<float>::infinity();
    for (const PlacedStep& step : sample.recorded[i].steps) {
      if (step.kind != TraversalStep::Kind::test) {
        ASSERT_LT(step.place, sample.tree.nodes().size());
      }
      tests += step.kind == TraversalStep::Kind::test ? 1 : 0;
      if (step.is_closest_yet && step.instance == kInvalidId) closest = step.distance;
    }
    if (!is_recorded_otherwise) {
      EXPECT_EQ(tests, ray_counts.primitives_tested);
    }
    if (!hit) continue;
    EXPECT_EQ(closest, hit.t);
    ++hit_count;
  }
  EXPECT_GT(hit_count, 100U);
}

TEST(StructureView, TellsInstancesFromTheirTriangles) {
  const Scene scene = testing::instanced_scene();
  StructureView view(scene, workload_camera(scene, ""), 1);
  const SceneAccelerator accelerator(scene, "bvh");
  view.add(accelerator, structure_json("bvh", accelerator.statistics(), 1));
  const nlohmann::ordered_json json = view.json("small", "grove inspect");
  EXPECT_EQ(json.at("structures").front().at("objects_shown"), true);
  const std::vector<std::uint8_t> kinds = from_base64(json.at("tested").at("kinds"));
  EXPECT_EQ(std::ranges::count(kinds, 2), 2) << "instances";
  EXPECT_GT(std::ranges::count(kinds, 0), 50) << "triangles";
}

TEST(ViewTree, LeavesOutObjectsThatAreTooMany) {
  const Scene scene = testing::instanced_scene();
  const SceneAccelerator accelerator(scene, "bvh");
  const ViewTree tree(scene, accelerator, accelerator.objects()[0]->statistics().nodes);
  EXPECT_FALSE(tree.is_whole());
  EXPECT_EQ(tree.nodes().size(), accelerator.top().statistics().nodes);
}

TEST(StructureView, RefusesWhatHasNoNodes) {
  const Scene scene = testing::small_scene();
  StructureView view(scene, workload_camera(scene, ""), 1);
  const SceneAccelerator accelerator(scene, "brute");
  EXPECT_THROW(view.add(accelerator, {}), UsageError);
}

}  // namespace
}  // namespace grove
