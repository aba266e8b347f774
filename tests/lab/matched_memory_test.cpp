#include "grove/lab/matched_memory.h"

#include <gtest/gtest.h>

#include "lab/small_scene.h"

namespace grove {
namespace {

TEST(MatchMemory, ChoosesTheLeafSizeThatTakesNearestToIt) {
  const Scene scene = testing::small_scene();
  const auto bytes = [&](const char* spec) { return SceneAccelerator(scene, spec).statistics().bytes; };
  const std::uint64_t largest = bytes("bvh:split=object-median,leaf-size=1");
  const std::uint64_t smallest = bytes("bvh:split=object-median,leaf-size=64");
  ASSERT_LT(smallest, largest);
  const std::vector<std::string> specs{"brute", "bvh:split=object-median", "fast"};
  for (const std::uint64_t wanted : {largest, smallest}) {
    const std::vector<MatchedStructure> matched = match_memory(scene, specs, wanted);
    ASSERT_EQ(matched.size(), 2U) << "brute force has no memory to match";
    EXPECT_EQ(matched[0].structure, "bvh:split=object-median");
    EXPECT_EQ(matched[0].matched.bytes, wanted) << matched[0].matched.spec;
    EXPECT_EQ(matched[1].matched.spec, "fast") << "it has no leaf size";
    EXPECT_EQ(matched[1].matched.bytes, bytes("fast"));
  }
}

TEST(MatchedMemory, ReportsEachStructure) {
  const std::vector<std::string> specs{"bvh", "kdtree"};
  const ReportSection section = matched_memory(testing::small_scene(), specs, "", {200, 1}, 1);
  ASSERT_TRUE(section.table.has_value());
  ASSERT_EQ(section.table->rows.size(), 2U);
  EXPECT_EQ(std::get<std::string>(section.table->rows[1][0]), "kdtree");
  EXPECT_GT(std::get<double>(section.table->rows[0][6]), 0.0) << "nanoseconds a ray";
}

}  // namespace
}  // namespace grove
