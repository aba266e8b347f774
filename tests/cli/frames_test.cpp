// Frames of an animation by `grove render --frames`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "scene/gltf_file.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

// A triangle that stands still for the first of three seconds, then moves.
void write_scene(const TemporaryDirectory& directory) {
  GltfFile file;
  file.add_node({{"mesh", file.add_triangle()}});
  const int times = file.add(std::vector<float>{0, 1, 3});
  const int places = file.add(std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}});
  file.json["animations"] = {{{"name", "slide"},
                              {"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  write_file(directory / "s.glb", file.glb());
}

std::vector<std::string> command(const std::vector<std::string>& more, const std::string& scene = "s.glb") {
  std::vector<std::string> words{"render", scene, "--width", "24", "--height", "16", "--spp", "2", "--threads", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Frames, AreWrittenEachToItsFile) {
  const TemporaryDirectory directory;
  write_scene(directory);
  const CommandResult result = run_command(directory, command({"-o", "f.%03d.png", "--frames", "1:4", "--fps", "1", "--json", "f.json"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"f.001.png", "f.002.png", "f.003.png"}) EXPECT_TRUE(std::filesystem::exists(directory / name)) << name;
  EXPECT_EQ(directory.entry_count(), 5U);
  EXPECT_THAT(result.out, HasSubstr("top level refit"));
  const nlohmann::json json = nlohmann::json::parse(read_file(directory / "f.json"));
  EXPECT_EQ(json.at("format"), "grove-frames");
  EXPECT_EQ(json.at("complete"), true);
  EXPECT_EQ(json.at("animation"), "slide");
  const auto& frames = json.at("frames");
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].at("built"), true);
  EXPECT_EQ(frames[1].at("moved_instances"), 1);
  EXPECT_EQ(frames[1].at("objects").size(), 0U);
  EXPECT_GT(frames[2].at("rays"), 0);
  EXPECT_NE(read_file(directory / "f.002.png"), read_file(directory / "f.003.png"));
}

TEST(Frames, AreThePicturesOfTheirTimes) {
  const TemporaryDirectory directory;
  write_scene(directory);
  const std::vector<std::string> view{"--eye", "1,0.5,6", "--look-at", "1,0.5,0", "--fov", "40"};
  const auto with_view = [&](std::vector<std::string> more) {
    more.insert(more.end(), view.begin(), view.end());
    return command(more);
  };
  EXPECT_EQ(run_command(directory, with_view({"-o", "f%d.exr", "--frames", "2:3", "--fps", "1"})).exit_code, 0);
  EXPECT_EQ(run_command(directory, with_view({"-o", "t.exr", "--time", "2", "--animation", "slide"})).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "f2.exr") == read_file(directory / "t.exr"));
  const CommandResult same =
      run_command(directory, with_view({"-o", "g%d.png", "--frames", "2:4", "--fps", "1", "--compare", "t.exr", "--json", "g.json"}));
  EXPECT_THAT(same.out, HasSubstr("RMSE 0,"));
  const nlohmann::json frames = nlohmann::json::parse(read_file(directory / "g.json")).at("frames");
  EXPECT_EQ(frames.at(0).at("comparison").at("rmse"), 0.0);
  EXPECT_GT(frames.at(1).at("comparison").at("rmse"), 0.0) << "a second later";
  EXPECT_EQ(run_command(directory, with_view({"-o", "g%d.png", "--frames", "2:3", "--fps", "1", "--compare", "f%d.exr"})).exit_code, 0);
  expect_failure(run_command(directory, with_view({"-o", "g%d.png", "--frames", "2:4", "--compare", "f%d.exr"})), 1);
  // The animation is three seconds long.
  EXPECT_EQ(run_command(directory, with_view({"-o", "l.exr", "--time", "8", "--loop"})).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "l.exr") == read_file(directory / "t.exr"));
  EXPECT_EQ(run_command(directory, with_view({"-o", "b.exr", "--time", "2", "--shutter", "1", "--fps", "1"})).exit_code, 0);
  EXPECT_FALSE(read_file(directory / "b.exr") == read_file(directory / "t.exr"));
}

TEST(Frames, TheCameraTurnsRoundAStillScene) {
  const TemporaryDirectory directory;
  const CommandResult result =
      run_command(directory, command({"-o", "o%d.exr", "--frames", "0:2", "--camera", "orbit"}, "builtin:rings?size=2"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("nothing moved"));
  EXPECT_THAT(result.err, HasSubstr("has no animation"));
  EXPECT_FALSE(read_file(directory / "o0.exr") == read_file(directory / "o1.exr"));
  // Half of the way round in one frame of two, or in the second of four.
  const auto turn = [](const char* frames, const char* degrees) {
    return command({"-o", "t%d.exr", "--frames", frames, "--camera", "orbit", "--turn", degrees}, "builtin:rings?size=2");
  };
  EXPECT_EQ(run_command(directory, turn("0:4", "720")).exit_code, 0);
  EXPECT_TRUE(read_file(directory / "o1.exr") == read_file(directory / "t1.exr"));
}

TEST(Frames, ResumeLeavesOutWhatIsThere) {
  const TemporaryDirectory directory;
  write_scene(directory);
  write_file(directory / "f1.png", "mine");
  const CommandResult result = run_command(directory, command({"-o", "f%d.png", "--frames", "0:3", "--resume"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_file(directory / "f1.png"), "mine");
  EXPECT_TRUE(std::filesystem::exists(directory / "f2.png"));
  EXPECT_EQ(run_command(directory, command({"-o", "f%d.png", "--frames", "0:3"})).exit_code, 0);
  EXPECT_NE(read_file(directory / "f1.png"), "mine") << "without it, files are replaced";
}

TEST(Frames, AnInterruptLeavesWholeFrames) {
  const TemporaryDirectory directory;
  write_scene(directory);
  CommandSettings settings;
  settings.signal = SIGINT;
  settings.signal_when_file = "f1.exr";
  const CommandResult result = run_command(directory, command({"-o", "f%d.exr", "--frames", "0:100000", "--json", "f.json"}), settings);
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("of 100000 frames are finished; the same command with --resume makes the others"));
  const nlohmann::json json = nlohmann::json::parse(read_file(directory / "f.json"));
  EXPECT_EQ(json.at("complete"), false);
  const std::size_t count = json.at("frames").size();
  EXPECT_GE(count, 2U);
  EXPECT_EQ(directory.entry_count(), count + 2) << "the scene, the JSON, and no part of a frame";
}

struct WrongFrames {
  std::vector<std::string> options;
  const char* message;
};

TEST(Frames, WrongOptionsAreExplained) {
  const TemporaryDirectory directory;
  write_scene(directory);
  const std::vector<WrongFrames> wrong{
      {{"-o", "f.png", "--frames", "0:2"}, "has no place for the number of the frame"},
      {{"-o", "f%d.png"}, "say which with --frames a:b"},
      {{"-o", "f%d%d.png", "--frames", "0:2"}, "may have one %d or %04d"},
      {{"-o", "f%d.png", "--frames", "2:2"}, "is no range a:b"},
      {{"-o", "f%d.png", "--frames", "0:2", "--checkpoint", "c.film"}, "--resume"},
      {{"-o", "f.png", "--animation", "jump"}, "has no animation 'jump'; there are 0 'slide'"},
      {{"-o", "f.png", "--look-at", "0,0,0"}, "--eye"},
      {{"-o", "f%d.png", "--frames", "0:2", "--turn", "9"}, "--camera orbit"},
      {{"-o", "f%d.png", "--frames", "0:2", "--compare", "r%x.exr"}, "--compare: 'r%x.exr'"},
      {{"-o", "f.png", "--eye", "0,0"}, "three numbers"},
      {{"-o", "f.png", "--eye", "1,1,1", "--look-at", "1,1,1"}, "the eye is where it looks at"},
      {{"-o", "f.png", "--time", "1", "--update", "hope"}, "auto, refit, rotate, rebuild"},
      {{"-o", "f.film", "--shutter", "0.5"}, "-o: a .film"},
      {{"-o", "f.png", "--shutter", "0.5", "--samples", "0:1"}, "--tile"},
  };
  for (const WrongFrames& w : wrong) {
    const CommandResult result = run_command(directory, command(w.options));
    expect_failure(result, 2);
    EXPECT_THAT(result.err, HasSubstr(w.message));
  }
  EXPECT_EQ(directory.entry_count(), 1U);
}

}  // namespace
}  // namespace grove::testing
