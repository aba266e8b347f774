#include "grove/lab/heat_map.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

HeatMap map_of(std::vector<std::uint16_t> steps) {
  HeatMap map;
  map.steps = std::move(steps);
  return map;
}

TEST(HeatMap, IsLittleEndianInBase64) {
  EXPECT_EQ(heat_map_base64(map_of({})), "");
  // Bytes 4d 61, "Ma"; then "Many" and "hands.".
  EXPECT_EQ(heat_map_base64(map_of({0x614d})), "TWE=");
  EXPECT_EQ(heat_map_base64(map_of({0x614d, 0x796e})), "TWFueQ==");
  EXPECT_EQ(heat_map_base64(map_of({0x6168, 0x646e, 0x2e73})), "aGFuZHMu");
  EXPECT_EQ(heat_map_base64(map_of({0xffff, 0xfbff, 0x0000})), "////+wAA");
}

}  // namespace
}  // namespace grove
