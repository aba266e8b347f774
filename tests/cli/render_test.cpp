#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "grove/scene/read_image.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> kSmall{"render", "builtin:cornell", "--width", "24", "--height", "16", "--spp", "2"};

std::vector<std::string> small_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kSmall;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Render, WritesBothKindsOfImageAndTheFigures) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, small_with({"-o", "a.png", "-o", "a.EXR", "--json", "a.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("Mrays/s"));
  EXPECT_EQ(directory.entry_count(), 3U) << "a temporary file is left";
  EXPECT_TRUE(read_file(directory / "a.png").starts_with("\x89PNG"));
  EXPECT_TRUE(read_file(directory / "a.EXR").starts_with("v/1\x01"));
  const auto json = nlohmann::json::parse(read_file(directory / "a.json"));
  EXPECT_EQ(json.at("width"), 24);
  EXPECT_EQ(json.at("height"), 16);
  EXPECT_EQ(json.at("samples_per_pixel"), 2);
  EXPECT_EQ(json.at("structure"), "bvh");
  EXPECT_GT(json.at("rays"), 24 * 16 * 2);
  EXPECT_EQ(json.at("interrupted"), false);
  EXPECT_EQ(json.at("paths"), 24 * 16 * 2);
  EXPECT_GT(json.at("paths_per_s"), 0.0);
  EXPECT_GT(json.at("rays_per_s"), json.at("paths_per_s"));
  EXPECT_EQ(json.at("samples_taken").at("most"), 2);
}

TEST(Render, StopsAtItsNoiseOrTime) {
  const TemporaryDirectory directory;
  const std::vector<std::string> base{"render", "builtin:cornell", "--width", "24", "--height", "16", "-o", "a.png", "--json", "a.json"};
  const auto figures = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = base;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_command(directory, arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("noise "));
    return nlohmann::json::parse(read_file(directory / "a.json"));
  };
  const auto by_noise = figures({"--noise", "0.5", "--min-spp", "4", "--spp", "256"});
  EXPECT_EQ(by_noise.at("samples_taken").at("least"), 4);
  EXPECT_LT(by_noise.at("samples_taken").at("mean"), 256);
  EXPECT_EQ(by_noise.at("completed_fraction"), 1.0);
  EXPECT_LE(by_noise.at("noise").at("root_mean_square"), 1.0);
  const auto by_time = figures({"--time-limit", "0.2"});
  EXPECT_EQ(by_time.at("out_of_time"), true);
  EXPECT_EQ(by_time.at("samples_taken").at("least"), by_time.at("samples_taken").at("most"));
  const CommandResult wrong = run_command(directory, small_with({"-o", "a.png", "--noise", "0.1", "--samples", "0:1"}));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("share work by --tile"));
  EXPECT_EQ(run_command(directory, small_with({"-o", "a.png", "--lights", "magic"})).exit_code, 2);
}

TEST(Render, OneSideKeepsTheAspect) {
  const TemporaryDirectory directory;
  const auto size_of = [&](const std::vector<std::string>& size) {
    std::vector<std::string> arguments{"render", "builtin:sphereflake", "--spp", "1", "--integrator", "normal", "-o", "a.png", "--json",
                                       "a.json"};
    arguments.insert(arguments.end(), size.begin(), size.end());
    EXPECT_EQ(run_command(directory, arguments).exit_code, 0);
    const auto json = nlohmann::json::parse(read_file(directory / "a.json"));
    return std::pair<double, double>(json.at("width"), json.at("height"));
  };
  const auto [width, height] = size_of({"--width", "64"});
  EXPECT_EQ(width, 64);
  EXPECT_EQ(size_of({"--height", std::to_string(static_cast<int>(height))}).first, 64);
}

TEST(Render, QuietSaysNothing) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, small_with({"-o", "a.png", "--quiet"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

TEST(Render, ThreadsAndStructureDoNotChangeTheImage) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, small_with({"-o", "a.exr", "--threads", "1"})).exit_code, 0);
  EXPECT_EQ(run_command(directory, small_with({"-o", "b.exr", "--threads", "3"})).exit_code, 0);
  EXPECT_EQ(run_command(directory, small_with({"-o", "c.exr", "--structure", "brute"})).exit_code, 0);
  EXPECT_EQ(run_command(directory, small_with({"-o", "d.exr", "--seed", "7"})).exit_code, 0);
  const std::string image = read_file(directory / "a.exr");
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(image == read_file(directory / "b.exr")) << "threads change the image";
  EXPECT_TRUE(image == read_file(directory / "c.exr")) << "the structure changes the image";
  EXPECT_FALSE(image == read_file(directory / "d.exr")) << "the seed does not change the image";
}

TEST(Render, HasEachIntegrator) {
  const TemporaryDirectory directory;
  for (const char* integrator : {"path", "ao", "normal", "depth", "cost"}) {
    const CommandResult result = run_command(directory, small_with({"-o", "a.png", "--integrator", integrator}));
    EXPECT_EQ(result.exit_code, 0) << integrator << ": " << result.err;
  }
}

TEST(Render, ComparesWithAnotherPicture) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, small_with({"-o", "a.exr", "-o", "a.film"})).exit_code, 0);
  const CommandResult same = run_command(directory, small_with({"-o", "b.exr", "--compare", "a.exr", "--json", "b.json"}));
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("RMSE 0, relMSE 0, FLIP 0, HDR-FLIP 0"));
  EXPECT_EQ(nlohmann::json::parse(read_file(directory / "b.json")).at("comparison").at("rmse"), 0.0);
  EXPECT_THAT(run_command(directory, {"merge", "a.film", "-o", "m.png", "--compare", "a.exr"}).out, HasSubstr("RMSE 0,"));
  const CommandResult other =
      run_command(directory, {"render", "builtin:cornell", "-o", "c.exr", "--compare", "a.exr", "--width", "25", "--height", "16"});
  expect_failure(other, 1);
  EXPECT_THAT(other.err, HasSubstr("24 x 16"));
  EXPECT_THAT(other.err, HasSubstr("25 x 16"));
  expect_failure(run_command(directory, small_with({"-o", "c.exr", "--compare", "none.exr"})), 1);
}

// Where nothing scatters only the sky is seen, and twice the radiance makes a picture of twice the brightness.
TEST(Render, SkyTakesThePlaceOfTheScenes) {
  const TemporaryDirectory directory;
  const std::vector<std::string> scene{"render", "builtin:rings", "--width", "24", "--height", "16", "--spp", "2", "--max-depth", "0"};
  const auto with_sky = [&](const char* sky, const std::vector<std::string>& more) {
    std::vector<std::string> command = scene;
    command.insert(command.end(), {"--sky", sky});
    command.insert(command.end(), more.begin(), more.end());
    return run_command(directory, command);
  };
  EXPECT_EQ(with_sky("0.25,0.5,1", {"-o", "a.exr"}).exit_code, 0);
  const CommandResult brighter = with_sky("0.5,1,2", {"-o", "b.exr", "--compare", "a.exr"});
  EXPECT_EQ(brighter.exit_code, 0) << brighter.err;
  EXPECT_THAT(brighter.out, HasSubstr("mean +100.00 %"));
}

TEST(Render, DenoisesAndKeepsTheFilm) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, small_with({"-o", "a.film"})).exit_code, 0);
  const CommandResult result =
      run_command(directory, small_with({"-o", "b.exr", "-o", "b.film", "--denoise", "spatial", "--layers", "all"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("denoised"));
  const std::string exr = read_file(directory / "b.exr");
  for (const char* name : {"noisy.R", "depth.Z", "motion.U", "variance.Y", "id.primitive"}) EXPECT_THAT(exr, HasSubstr(name));
  // But for the seconds in the header, which are of this run.
  const std::string film = read_file(directory / "a.film");
  const std::string other = read_file(directory / "b.film");
  const std::size_t pixels = std::size_t{24} * 16 * 40;
  ASSERT_GT(film.size(), pixels + 8);
  EXPECT_EQ(film.substr(film.size() - 8 - pixels, pixels), other.substr(other.size() - 8 - pixels, pixels));
}

class InterruptedRender : public ::testing::TestWithParam<int> {};

TEST_P(InterruptedRender, WritesWhatIsFinished) {
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.signal = GetParam();
  settings.signal_when = "structure";
  const CommandResult result = run_command(
      directory, {"render", "builtin:cornell", "--width", "512", "--height", "512", "--spp", "100000", "-o", "a.png", "-o", "a.exr"},
      settings);
  expect_failure(result, 130);
  EXPECT_THAT(result.err, HasSubstr("wrote what was finished"));
  const Image image = read_image(directory / "a.png");
  EXPECT_EQ(image.width, 512U);
  EXPECT_EQ(image.height, 512U);
  EXPECT_EQ(read_image(directory / "a.exr").width, 512U);
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedRender, ::testing::Values(SIGINT, SIGTERM));

TEST(Render, UnwritableOutputFailsBeforeTheWork) {
  const TemporaryDirectory directory;
  for (const std::string path : {"/nowhere/at/all/a.png", "directory.png"}) {
    std::filesystem::create_directory(directory / "directory.png");
    // A scene that would take long to read, and far too many samples.
    CommandSettings settings;
    settings.time_limit = 5.0;
    const CommandResult result =
        run_command(directory, {"render", "builtin:soup?triangles=20000000", "--spp", "100000", "-o", path}, settings);
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr(path));
    EXPECT_EQ(result.out, "");
  }
}

TEST(Render, MissingSceneFails) {
  const TemporaryDirectory directory;
  expect_failure(run_command(directory, {"render", "missing.glb", "-o", "a.png"}), 1);
  EXPECT_EQ(directory.entry_count(), 0U);
}

TEST(Render, UnknownSceneFormatFails) {
  const TemporaryDirectory directory;
  write_file(directory / "scene.txt", "words");
  expect_failure(run_command(directory, {"render", "scene.txt", "-o", "a.png"}), 1);
}

TEST(Render, TooLittleMemoryIsSaidInOneLine) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more memory than any limit";
#endif
  const TemporaryDirectory directory;
  CommandSettings settings;
  settings.memory_limit = std::uint64_t{1} << 30;
  const CommandResult result =
      run_command(directory, {"render", "builtin:cornell", "-o", "a.png", "--width", "16000", "--height", "16000"}, settings);
  expect_failure(result, 1);
  EXPECT_THAT(result.err, HasSubstr("memory"));
  EXPECT_EQ(directory.entry_count(), 0U);
}

}  // namespace
}  // namespace grove::testing
