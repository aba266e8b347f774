#include "grove/lab/node_boxes.h"

#include <gtest/gtest.h>

#include "grove/registry/registry.h"
#include "grove/render/scene_accelerator.h"
#include "lab/small_scene.h"
#include "lab/temporary_directory.h"

namespace grove {
namespace {

std::size_t count_lines(const std::string& text, const std::string& start) {
  std::size_t count = text.starts_with(start) ? 1 : 0;
  for (std::size_t at = text.find('\n' + start); at != std::string::npos; at = text.find('\n' + start, at + 1)) ++count;
  return count;
}

TEST(NodeBoxes, WritesEightCornersAndTwelveEdgesForEachNode) {
  const testing::TemporaryDirectory directory;
  const SceneAccelerator accelerator(testing::small_scene(), "bvh");
  const std::uint64_t count = write_node_boxes(directory / "boxes.obj", accelerator.top());
  EXPECT_EQ(count, accelerator.statistics().nodes);
  const std::string text = testing::read_file(directory / "boxes.obj");
  EXPECT_EQ(count_lines(text, "v "), 8 * count);
  EXPECT_EQ(count_lines(text, "l "), 12 * count);
}

TEST(NodeBoxes, TheFirstIsTheWholeScene) {
  const testing::TemporaryDirectory directory;
  const SceneAccelerator accelerator(testing::small_scene(), "bvh");
  EXPECT_EQ(write_node_boxes(directory / "boxes.obj", accelerator.top(), {0, 0}), 1U);
  const std::string text = testing::read_file(directory / "boxes.obj");
  EXPECT_NE(text.find("g depth_0\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("v 1 1 1\nl -8 -7\n"), std::string::npos) << text;
}

TEST(NodeBoxes, CanBeLimitedToLevels) {
  const testing::TemporaryDirectory directory;
  const SceneAccelerator accelerator(testing::small_scene(), "bvh");
  EXPECT_EQ(write_node_boxes(directory / "boxes.obj", accelerator.top(), {1, 1}), 2U);
  EXPECT_EQ(write_node_boxes(directory / "boxes.obj", accelerator.top(), {1000, 2000}), 0U);
}

}  // namespace
}  // namespace grove
