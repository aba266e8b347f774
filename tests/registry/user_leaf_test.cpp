// Primitives of a program's own cost a virtual call a leaf and none a node.

#include <gtest/gtest.h>

#include <cmath>

#include "grove/base/random.h"
#include "registry/matrix_geometry.h"

namespace grove::test {
namespace {

// Discs that lie flat, each at a height of its own or shared, which answer for whole leaves and count how they are asked.
class CountedDiscs final : public UserGeometry {
 public:
  CountedDiscs() {
    Random random(31);
    for (Vec3& centre : centres_) centre = {random.next_float(), random.next_float(), 0.1F * static_cast<float>(random.next_u32(10))};
  }
  [[nodiscard]] std::size_t size() const override { return std::size(centres_); }
  [[nodiscard]] Box bounds(std::size_t i) const override {
    const Vec3 extent(kRadius, kRadius, 0.0F);
    return {centres_[i] - extent, centres_[i] + extent};
  }
  [[nodiscard]] bool intersect_primitive(std::size_t i, const Ray& ray, Hit& hit) const override {
    ++single_calls;
    return meets(i, ray, hit);
  }
  [[nodiscard]] std::uint32_t intersect_primitives(std::span<const std::uint32_t> primitives, const Ray& ray, Hit* hits) const override {
    ++leaf_calls;
    EXPECT_LE(primitives.size(), kMostAtOnce);
    std::uint32_t met = 0;
    for (std::size_t k = 0; k < primitives.size(); ++k) met |= std::uint32_t{meets(primitives[k], ray, hits[k])} << k;
    return met;
  }

  mutable std::uint64_t leaf_calls = 0;
  mutable std::uint64_t single_calls = 0;

 private:
  static constexpr float kRadius = 0.03F;

  [[nodiscard]] bool meets(std::size_t i, const Ray& ray, Hit& hit) const {
    const float t = (centres_[i].z - ray.origin.z) / ray.direction.z;
    if (!(t >= ray.t_min && t <= ray.t_max)) return false;
    const Vec3 off = ray.at(t) - centres_[i];
    if (off.x * off.x + off.y * off.y > kRadius * kRadius) return false;
    hit.t = t;
    return true;
  }

  Vec3 centres_[3000];
};

TEST(UserLeaves, AreAskedAboutInOneCall) {
  const auto discs = std::make_shared<const CountedDiscs>();
  const GeometryPointer geometry = std::shared_ptr<const UserGeometry>(discs);
  const auto brute = build(geometry, "brute");
  Random random(32);
  std::vector<Ray> rays(500);
  for (Ray& ray : rays) {
    ray.origin = {random.next_float(), random.next_float(), 2.0F};
    ray.direction = {0.3F * random.next_float(-1.0F, 1.0F), 0.3F * random.next_float(-1.0F, 1.0F), -1.0F};
  }
  std::vector<Hit> expected(rays.size());
  brute->intersect(rays, expected);
  for (const char* const spec : {"fast", "bvh", "bvh:bounds=sphere"}) {
    const auto structure = build(geometry, spec);
    discs->leaf_calls = discs->single_calls = 0;
    std::uint64_t leaves = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      TraversalCounts counts;
      const Hit hit = structure->closest_hit(rays[i], &counts);
      EXPECT_TRUE(same_bits(hit, expected[i])) << spec << ", ray " << i;
      EXPECT_EQ(structure->any_hit(rays[i], nullptr), static_cast<bool>(expected[i])) << spec;
      leaves += counts.leaves_entered;
    }
    EXPECT_EQ(discs->single_calls, 0U) << spec;
    EXPECT_GT(leaves, rays.size()) << spec;
    // Any hit enters as many leaves as the closest one at most.
    EXPECT_GE(discs->leaf_calls, leaves) << spec;
    EXPECT_LE(discs->leaf_calls, 2 * leaves) << spec;
  }
}

}  // namespace
}  // namespace grove::test
