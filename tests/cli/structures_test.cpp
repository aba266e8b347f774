#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "grove/registry/registry.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

TEST(Structures, ListsEveryFamilyAndKey) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"structures"});
  EXPECT_EQ(result.exit_code, 0);
  for (const StructureFamily& family : structure_families()) {
    EXPECT_THAT(result.out, HasSubstr(std::string(family.name)));
    for (const SpecKey& key : family.keys) EXPECT_THAT(result.out, HasSubstr(std::string(key.name)));
  }
}

TEST(Structures, JsonIsTheRegistry) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, {"structures", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("default"), std::string(kDefaultSpec));
  const auto& families = json.at("families");
  ASSERT_EQ(families.size(), structure_families().size());
  for (std::size_t i = 0; i < families.size(); ++i) {
    const StructureFamily& family = structure_families()[i];
    EXPECT_EQ(families[i].at("name"), std::string(family.name));
    ASSERT_EQ(families[i].at("keys").size(), family.keys.size());
    for (std::size_t k = 0; k < family.keys.size(); ++k) {
      const auto& entry = families[i].at("keys").at(k);
      EXPECT_EQ(entry.at("name"), std::string(family.keys[k].name));
      EXPECT_TRUE(entry.contains("default"));
      EXPECT_TRUE(entry.contains("values") || (entry.contains("minimum") && entry.contains("maximum")));
    }
  }
}

}  // namespace
}  // namespace grove::testing
