#include "grove/lab/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grove/lab/workload.h"
#include "lab/small_scene.h"

namespace grove {
namespace {

class ReferenceTest : public ::testing::Test {
 protected:
  ReferenceTest() {
    Random random(2);
    for (Ray& ray : rays_) {
      for (int axis = 0; axis < 3; ++axis) {
        ray.origin[axis] = random.next_float();
        ray.direction[axis] = random.next_float(-1.0F, 1.0F);
      }
    }
    trace(brute_.top(), Query::closest, rays_, hits_);
  }

  Scene scene_ = testing::small_scene();
  SceneAccelerator brute_{scene_, "brute"};
  std::vector<Ray> rays_ = std::vector<Ray>(1000);
  std::vector<Hit> hits_ = std::vector<Hit>(1000);
};

TEST_F(ReferenceTest, RightHitsHaveNoMismatches) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 1'000'000);
  EXPECT_EQ(reference.sampled_count(), 1000U);
  EXPECT_EQ(reference.count_mismatches(hits_), 0U);
}

TEST_F(ReferenceTest, AnyBitCounts) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 1'000'000);
  hits_[1].t = std::nextafter(hits_[1].t, 0.0F);
  hits_[500].u = -hits_[500].u;
  hits_[998].primitive ^= 1U;
  hits_[999].instance = 0;
  EXPECT_EQ(reference.count_mismatches(hits_), 4U);
}

TEST_F(ReferenceTest, RoundingIsToldFromBeingFarOff) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 1'000'000);
  std::size_t found = 0;
  while (!hits_[found]) ++found;
  hits_[found].t *= 1.0001F;
  hits_[found].primitive ^= 1U;
  EXPECT_EQ(reference.count_far_off(hits_), 0U);
  hits_[found].t *= 1.01F;
  EXPECT_EQ(reference.count_far_off(hits_), 1U);
  hits_[found] = Hit{};
  EXPECT_EQ(reference.count_far_off(hits_), 1U);
}

TEST_F(ReferenceTest, ASmallBudgetChecksASampleAndTheOthersAgainstTheFirst) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 212 * 100);
  EXPECT_EQ(reference.sampled_count(), 100U);
  std::vector<Hit> wrong = hits_;
  wrong[10].primitive ^= 1U;  // in the sample of every tenth ray
  wrong[11].primitive ^= 1U;  // not in it
  EXPECT_EQ(reference.count_mismatches(wrong), 1U);
  EXPECT_EQ(reference.count_mismatches(hits_), 1U) << "ray 11 differs from the first structure";
}

TEST_F(ReferenceTest, ChecksAnEvenPartOfTheRays) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 1'000'000);
  std::vector<Hit> part;
  for (std::size_t i = 0; i < hits_.size(); i += 3) part.push_back(hits_[i]);
  EXPECT_EQ(reference.count_mismatches(part, 3), 0U);
  part[7].primitive ^= 1U;
  EXPECT_EQ(reference.count_mismatches(part, 3), 1U);
}

TEST_F(ReferenceTest, APartDoesNotSettleWhatIsRight) {
  Reference reference(brute_.top(), 212, ray_set("", rays_, Query::closest), 212 * 100);
  std::vector<Hit> wrong(500);
  for (std::size_t k = 0; k < wrong.size(); ++k) wrong[k] = hits_[2 * k];
  wrong[1].primitive ^= 1U;  // ray 2, not in the sample of every tenth ray
  EXPECT_EQ(reference.count_mismatches(wrong, 2), 0U);
  EXPECT_EQ(reference.count_mismatches(hits_), 0U);
  EXPECT_EQ(reference.count_mismatches(wrong, 2), 1U);
}

TEST_F(ReferenceTest, ChecksAtLeastOneRay) {
  EXPECT_EQ(Reference(brute_.top(), 212, ray_set("", rays_, Query::any), 0).sampled_count(), 1U);
  EXPECT_EQ(Reference(brute_.top(), 212, ray_set("", {}, Query::any), 1000).sampled_count(), 0U);
}

}  // namespace
}  // namespace grove
