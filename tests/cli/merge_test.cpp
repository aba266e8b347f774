#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_command.h"
#include "grove/render/saved/film_file.h"
#include "grove/scene/read_image.h"

namespace grove::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Merge : public ::testing::Test {
 protected:
  void render(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", "builtin:cornell", "--width", "70", "--height", "40", "--spp", "6"};
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult result = run_command(directory_, words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  [[nodiscard]] CommandResult merge(std::vector<std::string> words) const {
    words.insert(words.begin(), "merge");
    return run_command(directory_, words);
  }

  TemporaryDirectory directory_;
};

TEST_F(Merge, TilesMakeTheVeryFilesOfOneRender) {
  render({"-o", "whole.exr", "-o", "whole.png", "--exposure", "1"});
  render({"-o", "a.film", "--tile", "1/3"});
  render({"-o", "b.film", "--tile", "2/3", "--threads", "1"});
  render({"-o", "c.film", "--tile", "3/3", "--structure", "fast"});
  const CommandResult result = merge({"c.film", "a.film", "b.film", "-o", "m.exr", "-o", "m.png", "-o", "m.film", "--exposure", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("from 3 films"));
  EXPECT_TRUE(read_file(directory_ / "m.exr") == read_file(directory_ / "whole.exr"));
  EXPECT_TRUE(read_file(directory_ / "m.png") == read_file(directory_ / "whole.png"));
  // What comes out is a film like others, with which a render goes on.
  render({"-o", "again.exr", "--checkpoint", "m.film"});
  EXPECT_TRUE(read_file(directory_ / "again.exr") == read_file(directory_ / "whole.exr"));
}

TEST_F(Merge, SampleRangesMakeTheSameFileInAnyOrder) {
  render({"-o", "a.film", "--samples", "0:1"});
  render({"-o", "b.film", "--samples", "1:4"});
  render({"-o", "c.film", "--samples", "4:6"});
  EXPECT_EQ(merge({"a.film", "b.film", "c.film", "-o", "1.exr", "--quiet"}).exit_code, 0);
  EXPECT_EQ(merge({"c.film", "b.film", "a.film", "-o", "2.exr", "--quiet"}).exit_code, 0);
  EXPECT_TRUE(read_file(directory_ / "1.exr") == read_file(directory_ / "2.exr"));
}

TEST_F(Merge, GapsAreErrorsUnlessAllowed) {
  render({"-o", "a.film", "--tile", "1/3"});
  render({"-o", "b.film", "--tile", "3/3", "--samples", "2:6"});
  const CommandResult refused = merge({"a.film", "b.film", "-o", "m.exr"});
  expect_failure(refused, 1);
  EXPECT_THAT(refused.err, HasSubstr("--tile 2/3 --samples 0:6, --tile 3/3 --samples 0:2; merge what there is with --partial"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "m.exr"));
  const CommandResult allowed = merge({"a.film", "b.film", "-o", "m.exr", "--partial"});
  EXPECT_EQ(allowed.exit_code, 0);
  EXPECT_THAT(allowed.err, HasSubstr("warning: no part holds --tile 2/3"));
  const Image image = read_image(directory_ / "m.exr");
  const auto red = [&](std::size_t x, std::size_t y) { return image.floats.at((y * image.width + x) * image.channels); };
  // Tiles 6, 7 and 8 of five across are in the middle row, where the box is.
  EXPECT_GT(red(24, 24), 0.0F);
  EXPECT_EQ(red(40, 24), 0.0F);
  EXPECT_GT(red(50, 24), 0.0F);
  expect_failure(merge({"a.film", "b.film", "-o", "m.film", "--partial"}), 2);
}

TEST_F(Merge, FilmsThatDoNotBelongTogetherAreRefused) {
  render({"-o", "a.film", "--tile", "1/2"});
  render({"-o", "b.film", "--tile", "2/2", "--seed", "4"});
  render({"-o", "c.film", "--samples", "0:1"});
  const CommandResult other = merge({"a.film", "b.film", "-o", "m.exr"});
  expect_failure(other, 1);
  EXPECT_THAT(other.err, HasSubstr("b.film: is of another picture than a.film: seed 4 instead of 0"));
  const CommandResult twice = merge({"a.film", "c.film", "-o", "m.exr"});
  expect_failure(twice, 1);
  EXPECT_THAT(twice.err, AllOf(HasSubstr("a.film"), HasSubstr("c.film"), HasSubstr("the same samples")));
}

TEST_F(Merge, FilesThatAreNoFilmsAreNamed) {
  render({"-o", "a.film"});
  write_file(directory_ / "words.film", "words");
  write_file(directory_ / "cut.film", read_file(directory_ / "a.film").substr(0, 9000));
  for (const char* name : {"words.film", "cut.film", "missing.film", "."}) {
    const CommandResult result = merge({"a.film", name, "-o", "m.exr"});
    expect_failure(result, 1);
    EXPECT_THAT(result.err, HasSubstr(name));
  }
  EXPECT_EQ(directory_.entry_count(), 3U);
}

TEST_F(Merge, FiguresTellWhichPart) {
  render({"-o", "a.film", "--tile", "2/3", "--samples", "1:5", "--json", "a.json"});
  const auto json = nlohmann::json::parse(read_file(directory_ / "a.json"));
  EXPECT_EQ(json.at("tiles").at("share"), 1);
  EXPECT_EQ(json.at("tiles").at("of"), 3);
  EXPECT_EQ(json.at("samples").at("first"), 1);
  EXPECT_EQ(json.at("samples").at("end"), 5);
  EXPECT_EQ(read_film_header(directory_ / "a.film").part.text(), "--tile 2/3 --samples 1:5");
}

}  // namespace
}  // namespace grove::testing
