#include "grove/lab/spread.h"

#include <gtest/gtest.h>

namespace grove {
namespace {

TEST(Spread, OfNothingIsZero) {
  EXPECT_EQ(spread_of({}), (Spread{0.0, 0.0, 0.0}));
}
TEST(Spread, OfOneValue) {
  EXPECT_EQ(spread_of({3.0}), (Spread{3.0, 3.0, 3.0}));
}
TEST(Spread, OfAnOddNumberTakesTheMiddle) {
  EXPECT_EQ(spread_of({9.0, 1.0, 2.0}), (Spread{2.0, 1.0, 9.0}));
}
TEST(Spread, OfAnEvenNumberTakesTheMeanOfTheMiddle) {
  EXPECT_EQ(spread_of({4.0, 100.0, 1.0, 2.0}), (Spread{3.0, 1.0, 100.0}));
}

}  // namespace
}  // namespace grove
