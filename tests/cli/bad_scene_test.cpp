// Every broken or tricky scene file is either traced or refused with one line, soon and in bounded memory.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "cli/run_command.h"
#include "grove/lab/ray_file.h"

namespace grove::testing {
namespace {

/// Files that readers do not read themselves.
bool is_companion(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".bin" || extension == ".mtl" || extension == ".md" || extension == ".txt";
}

std::vector<std::string> bad_scenes() {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(GROVE_SOURCE_DIR "/../shared/scenes/bad", error)) {
    if (!is_companion(entry.path())) files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class BadScene : public ::testing::TestWithParam<std::string> {};
// The suite is empty where the scenes are not there; BadScenes.AreThere says so.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(BadScene);

TEST_P(BadScene, IsTracedOrRefused) {
  const TemporaryDirectory directory;
  std::vector<Ray> rays(100);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].origin = Vec3(0.01F * static_cast<float>(i), 0.3F, -10.0F);
  write_rays(directory / "rays.npy", rays);
  CommandSettings settings;
  settings.time_limit = 20.0;
  settings.memory_limit = std::uint64_t{1} << 30;
  const CommandResult result = run_command(directory, {"trace", GetParam(), "--rays", "rays.npy", "--hits", "hits.npy"}, settings);
  if (result.exit_code == 0) {
    EXPECT_EQ(directory.entry_count(), 2U);
    return;
  }
  expect_failure(result, 1);
  EXPECT_EQ(directory.entry_count(), 1U) << "something was written";
  EXPECT_NE(result.err.find(std::filesystem::path(GetParam()).filename().string()), std::string::npos) << result.err;
}

INSTANTIATE_TEST_SUITE_P(All, BadScene, ::testing::ValuesIn(bad_scenes()), [](const auto& test) {
  std::string name = std::filesystem::path(test.param).filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

TEST(BadScenes, AreThere) {
  if (bad_scenes().empty()) GTEST_SKIP() << "no ../shared/scenes/bad beside the repository";
  EXPECT_GT(bad_scenes().size(), 20U);
}

}  // namespace
}  // namespace grove::testing
