// What `grove render --checkpoint` promises, with real signals and a real file system.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "grove/render/saved/film_file.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> command(std::uint32_t samples, const std::vector<std::string>& more) {
  std::vector<std::string> words{"render", "builtin:cornell", "--width", "160", "--height", "96", "--spp", std::to_string(samples)};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// So many samples that a render takes about this long on this machine.
std::uint32_t samples_for(const TemporaryDirectory& directory, double seconds) {
  constexpr std::uint32_t kTrial = 8;
  EXPECT_EQ(run_command(directory, command(kTrial, {"-o", "trial.png", "--json", "trial.json"})).exit_code, 0);
  const double trial = nlohmann::json::parse(read_file(directory / "trial.json")).at("render_seconds");
  std::filesystem::remove(directory / "trial.png");
  std::filesystem::remove(directory / "trial.json");
  return static_cast<std::uint32_t>(std::clamp(kTrial * seconds / trial, 16.0, 1e6));
}

TEST(Checkpoint, KilledRendersGoOnToTheSameBits) {
  const TemporaryDirectory directory;
  const std::uint32_t samples = samples_for(directory, 3.0);
  const std::vector<std::string> words = command(samples, {"-o", "a.exr", "--checkpoint", "a.film", "--checkpoint-interval", "0.1"});
  CommandSettings kill;
  kill.signal = SIGKILL;
  kill.signal_when = "structure";
  std::uint64_t rays = 0;
  for (int run = 0; run < 3; ++run) {
    EXPECT_EQ(run_command(directory, words, kill).exit_code, 128 + SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(directory / "a.exr"));
    // Nothing is lost but the last interval: there is a sound film that has come further.
    const SavedFilm saved = read_film(directory / "a.film");
    EXPECT_GT(saved.header.rays_traced, rays);
    rays = saved.header.rays_traced;
  }
  const CommandResult last = run_command(directory, words);
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_THAT(last.out, HasSubstr("goes on from a.film"));
  EXPECT_EQ(run_command(directory, command(samples, {"-o", "whole.exr"})).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "a.exr") == read_file(directory / "whole.exr"));
}

class InterruptedCheckpoint : public ::testing::TestWithParam<int> {};

TEST_P(InterruptedCheckpoint, IsSavedAndGoneOnWith) {
  const TemporaryDirectory directory;
  const std::uint32_t samples = samples_for(directory, 2.0);
  // No interval passes: what is saved is saved because of the signal.
  const std::vector<std::string> words = command(samples, {"-o", "a.exr", "--checkpoint", "a.film", "--checkpoint-interval", "1000"});
  CommandSettings settings;
  settings.signal = GetParam();
  settings.signal_when = "structure";
  const CommandResult interrupted = run_command(directory, words, settings);
  expect_failure(interrupted, 130);
  EXPECT_THAT(interrupted.err, HasSubstr("the same command goes on from a.film"));
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";
  EXPECT_EQ(run_command(directory, words).exit_code, 0);
  EXPECT_EQ(run_command(directory, command(samples, {"-o", "whole.exr"})).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "a.exr") == read_file(directory / "whole.exr"));
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedCheckpoint, ::testing::Values(SIGINT, SIGTERM));

TEST(Checkpoint, FinishedOnesTakeMoreSamples) {
  const TemporaryDirectory directory;
  const std::vector<std::string> files{"-o", "a.exr", "--checkpoint", "a.film"};
  EXPECT_EQ(run_command(directory, command(3, files)).exit_code, 0);
  EXPECT_EQ(run_command(directory, command(7, files)).exit_code, 0);
  EXPECT_EQ(run_command(directory, command(7, {"-o", "whole.exr"})).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "a.exr") == read_file(directory / "whole.exr"));
}

TEST(Checkpoint, OfAnotherRenderIsRefusedAndKept) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, command(4, {"-o", "a.png", "--checkpoint", "a.film"})).exit_code, 0);
  const std::string film = read_file(directory / "a.film");
  const std::vector<std::pair<std::vector<std::string>, std::string>> others{
      {command(4, {"--seed", "9"}), "seed 0 instead of 9"},
      {command(4, {"--max-depth", "2"}), "max-depth 8 instead of 2"},
      {command(4, {"--integrator", "ao"}), "integrator path instead of ao"},
      {command(4, {"--tile", "1/2"}), "--samples 0:4 instead of --tile 1/2 --samples 0:4"},
      {command(4, {"--samples", "1:4"}), "--samples 0:4 instead of --samples 1:4"},
      {command(3, {}), "--samples 0:4 instead of --samples 0:3"},
      {{"render", "builtin:rings", "--width", "160", "--height", "96", "--spp", "4"}, "scene contents"}};
  for (auto [words, message] : others) {
    words.insert(words.end(), {"-o", "b.png", "--checkpoint", "a.film"});
    const CommandResult result = run_command(directory, words);
    expect_failure(result, 2);
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.err, HasSubstr("--restart"));
    EXPECT_TRUE(read_file(directory / "a.film") == film) << message;
  }
  EXPECT_EQ(directory.entry_count(), 2U);
  // Threads and structure do not matter; and it may be told to start anew.
  EXPECT_EQ(
      run_command(directory, command(4, {"-o", "a.png", "--checkpoint", "a.film", "--threads", "1", "--structure", "kdtree"})).exit_code,
      0);
  EXPECT_EQ(run_command(directory, command(4, {"-o", "a.png", "--checkpoint", "a.film", "--seed", "9", "--restart"})).exit_code, 0);
  EXPECT_EQ(fact_of(read_film_header(directory / "a.film").picture, "seed"), "9");
}

TEST(Checkpoint, DamagedFilesAreRefusedBeforeTheWork) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, command(1, {"-o", "a.png", "--checkpoint", "a.film"})).exit_code, 0);
  const std::string film = read_file(directory / "a.film");
  for (const std::string& bytes : {film.substr(0, film.size() / 2), std::string("words"), std::string()}) {
    write_file(directory / "a.film", bytes);
    CommandSettings settings;
    settings.time_limit = 5.0;
    const CommandResult result = run_command(
        directory, {"render", "builtin:soup?triangles=20000000", "--spp", "100000", "-o", "a.png", "--checkpoint", "a.film"}, settings);
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr("a.film: "));
    EXPECT_THAT(result.err, HasSubstr("--restart"));
    EXPECT_EQ(read_file(directory / "a.film"), bytes);
  }
}

// A film of 160 x 96 pixels takes 660 KB, the picture less than a tenth of that.
TEST(Checkpoint, FullDiskCostsTheNewFilmOnly) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_command(directory, command(2, {"-o", "a.png", "--checkpoint", "a.film"})).exit_code, 0);
  const std::string film = read_file(directory / "a.film");
  std::filesystem::remove(directory / "a.png");
  const std::uint32_t samples = samples_for(directory, 1.0);
  CommandSettings settings;
  settings.file_limit = 300'000;
  const CommandResult result =
      run_command(directory, command(samples, {"-o", "a.png", "--checkpoint", "a.film", "--checkpoint-interval", "0.1"}), settings);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("warning: a.film: cannot be written"));
  EXPECT_THAT(result.err, HasSubstr("grove render: a.film: cannot be written"));
  EXPECT_THAT(result.out, HasSubstr("wrote      a.png"));
  EXPECT_TRUE(read_file(directory / "a.film") == film);
  EXPECT_EQ(directory.entry_count(), 2U) << "a temporary file is left";
}

TEST(Checkpoint, QuietSaysNothing) {
  const TemporaryDirectory directory;
  for (int run = 0; run < 2; ++run) {
    const CommandResult result = run_command(directory, command(1, {"-o", "a.png", "--checkpoint", "a.film", "--quiet"}));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out + result.err, "");
  }
}

}  // namespace
}  // namespace grove::testing
