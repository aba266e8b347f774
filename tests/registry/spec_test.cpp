#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "grove/base/error.h"
#include "grove/registry/registry.h"

namespace grove {
namespace {

using testing::HasSubstr;

std::string message_of(std::string_view spec) {
  try {
    static_cast<void>(canonical_spec(spec));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(Spec, CanonicalFormNamesOnlyWhatDiffersFromTheDefaults) {
  EXPECT_EQ(canonical_spec("bvh"), "bvh");
  EXPECT_EQ(canonical_spec("bvh:split=binned,arity=2"), "bvh");
  EXPECT_EQ(canonical_spec("bvh:leaf-size=004"), "bvh:leaf-size=4");
  EXPECT_EQ(canonical_spec("brute"), "brute");
}

TEST(Spec, AShortNameSetsItsKey) {
  EXPECT_EQ(canonical_spec("octree-r"), "octree:split=octree-r");
  EXPECT_EQ(canonical_spec("octree-r:candidates=4"), "octree:split=octree-r,candidates=4");
  EXPECT_THAT(message_of("octree-r:split=median"), HasSubstr("twice"));
  EXPECT_THAT(message_of("octree-r:colour=red"), HasSubstr("octree"));
  EXPECT_THAT(message_of("quadtree"), HasSubstr("octree-r"));
}

TEST(Spec, ErrorsListWhatIsAllowed) {
  EXPECT_THAT(message_of("quadtree"), HasSubstr("brute, bvh"));
  EXPECT_THAT(message_of(""), HasSubstr("brute, bvh"));
  EXPECT_THAT(message_of("bvh:colour=red"), HasSubstr("leaf-size"));
  EXPECT_THAT(message_of("bvh:split=magic"), HasSubstr("binned"));
  EXPECT_THAT(message_of("bvh:leaf-size=0"), HasSubstr("from 1 to 64"));
  EXPECT_THAT(message_of("bvh:leaf-size=99999999999999999999"), HasSubstr("from 1 to 64"));
  EXPECT_THAT(message_of("bvh:leaf-size=4x"), HasSubstr("whole number"));
  EXPECT_THAT(message_of("bvh:leaf-size"), HasSubstr("key=value"));
  EXPECT_THAT(message_of("bvh:"), HasSubstr("key=value"));
  EXPECT_THAT(message_of("bvh:leaf-size=4,"), HasSubstr("key=value"));
  EXPECT_THAT(message_of("bvh:leaf-size=4,leaf-size=8"), HasSubstr("twice"));
  EXPECT_THAT(message_of("brute:leaf-size=4"), HasSubstr("it has none"));
}

TEST(Spec, EveryErrorIsOneLine) {
  for (const std::string_view spec : {"x", "bvh:x=1", "bvh:split=x", "bvh:leaf-size=x"})
    EXPECT_THAT(message_of(spec), testing::Not(HasSubstr("\n"))) << spec;
}

TEST(Registry, EveryRepresentativeSpecIsCanonicalAndBuilds) {
  for (const std::string_view spec : representative_specs()) {
    EXPECT_EQ(canonical_spec(spec), spec);
    const auto structure = build(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), spec);
    EXPECT_EQ(structure->spec(), spec);
    EXPECT_TRUE(structure->intersect(Ray{{0.2F, 0.2F, 1.0F}, 0.0F, {0.0F, 0.0F, -1.0F}}));
  }
}

TEST(Registry, AMeshChecksItsIndices) {
  EXPECT_THROW(TriangleMesh({{0, 0, 0}}, {{0, 0, 1}}), InputError);
}

}  // namespace
}  // namespace grove
