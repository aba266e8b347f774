// Every wrong command gets exit code 2, one line that names the remedy, and leaves nothing behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_command.h"

namespace grove::testing {
namespace {

using ::testing::HasSubstr;

struct WrongCommand {
  const char* name;
  std::vector<std::string> arguments;
  const char* message;
};

class WrongCommandTest : public ::testing::TestWithParam<WrongCommand> {};

TEST_P(WrongCommandTest, IsExplainedInOneLine) {
  const TemporaryDirectory directory;
  const CommandResult result = run_command(directory, GetParam().arguments);
  expect_failure(result, 2);
  EXPECT_THAT(result.err, HasSubstr(GetParam().message));
  EXPECT_THAT(result.err, HasSubstr("--help"));
  EXPECT_EQ(directory.entry_count(), 0U) << "something was written";
}

std::vector<WrongCommand> wrong_commands() {
  std::vector<WrongCommand> commands{
      {"NoVerb", {}, "render, merge, trace, compare, inspect, animate, reproduce, structures"},
      {"UnknownVerb", {"paint", "scene.glb"}, "unknown verb 'paint'"},
      {"UnknownProgramOption", {"--wat"}, "--wat"},
      {"NoScene", {"render", "-o", "a.png"}, "SCENE is required"},
      {"NoImage", {"render", "builtin:cornell"}, "--output is required"},
      {"NoRays", {"trace", "builtin:cornell", "--hits", "h.npy"}, "--rays is required"},
      {"TwoScenes", {"inspect", "builtin:cornell", "builtin:rings"}, "builtin:rings"},
      {"UnknownOption", {"render", "builtin:cornell", "-o", "a.png", "--wat"}, "--wat"},
      {"OptionOfAnotherVerb", {"inspect", "builtin:cornell", "--spp", "4"}, "--spp"},
      {"NoValue", {"render", "builtin:cornell", "-o", "a.png", "--spp"}, "--spp"},
      {"Twice", {"render", "builtin:cornell", "-o", "a.png", "--spp", "1", "--spp", "2"}, "--spp"},
      {"UnknownExtension", {"render", "builtin:cornell", "-o", "a.jpg"}, ".exr"},
      {"NoExtension", {"render", "builtin:cornell", "-o", "picture"}, ".exr"},
      {"UnknownIntegrator", {"render", "builtin:cornell", "-o", "a.png", "--integrator", "magic"}, "ao"},
      {"UnknownCamera", {"render", "builtin:cornell", "-o", "a.png", "--camera", "none such"}, "none such"},
      {"NoSuchTile", {"render", "builtin:cornell", "-o", "a.png", "--tile", "5/4"}, "1/4, 2/4, 3/4 and 4/4"},
      {"TileFromZero", {"render", "builtin:cornell", "-o", "a.png", "--tile", "0/4"}, "--tile"},
      {"TileOfText", {"render", "builtin:cornell", "-o", "a.png", "--tile", "1/x"}, "--tile"},
      {"EmptyTile", {"render", "builtin:cornell", "-o", "a.png", "--tile", ""}, "--tile"},
      {"MoreSharesThanTiles", {"render", "builtin:cornell", "-o", "a.png", "--width", "20", "--height", "20", "--tile", "5/5"}, "has 4"},
      {"EmptySamples", {"render", "builtin:cornell", "-o", "a.png", "--samples", ""}, "--samples"},
      {"NoSuchSamples", {"render", "builtin:cornell", "-o", "a.png", "--spp", "8", "--samples", "4:9"}, "0:8"},
      {"SamplesBackwards", {"render", "builtin:cornell", "-o", "a.png", "--samples", "9:4"}, "--samples"},
      {"EmptyCheckpoint", {"render", "builtin:cornell", "-o", "a.png", "--checkpoint", ""}, "--checkpoint"},
      {"CheckpointIsPicture", {"render", "builtin:cornell", "-o", "a.png", "--checkpoint", "./a.png"}, "a.png"},
      {"RestartOfNothing", {"render", "builtin:cornell", "-o", "a.png", "--restart"}, "--checkpoint"},
      {"IntervalOfNothing", {"render", "builtin:cornell", "-o", "a.png", "--checkpoint-interval", "5"}, "--checkpoint"},
      {"UnknownToneMap", {"render", "builtin:cornell", "-o", "a.png", "--tone-map", "agfa"}, "none, filmic, aces"},
      {"UnknownLayer", {"render", "builtin:cornell", "-o", "a.exr", "--layers", "depth,heat"}, "'heat'"},
      {"SkyOfTwoNumbers", {"render", "builtin:cornell", "-o", "a.png", "--sky", "1,1"}, "three numbers r,g,b"},
      {"NegativeSky", {"render", "builtin:cornell", "-o", "a.png", "--sky", "1,1,-1"}, "negative"},
      {"UnknownDenoiser", {"render", "builtin:cornell", "-o", "a.png", "--denoise", "magic"}, "off, spatial, temporal"},
      {"DenoisedNormals",
       {"render", "builtin:cornell", "-o", "a.png", "--denoise", "spatial", "--integrator", "normal"},
       "--integrator path"},
      {"NoFilms", {"merge", "-o", "a.png"}, "FILMS is required"},
      {"MergedIntoNothing", {"merge", "a.film"}, "--output is required"},
      {"MergedIntoText", {"merge", "a.film", "-o", "a.txt"}, ".film"},
      {"UnknownFamily", {"inspect", "builtin:cornell", "--structure", "oak"}, "bvh"},
      {"UnknownKey", {"inspect", "builtin:cornell", "--structure", "bvh:colour=red"}, "leaf-size"},
      {"UnknownValue", {"inspect", "builtin:cornell", "--structure", "bvh:split=banana"}, "binned"},
      {"EmptySpec", {"inspect", "builtin:cornell", "--structure", ""}, "bvh"},
      {"UnknownBuiltin", {"inspect", "builtin:nothing"}, "sphereflake"},
      {"UnknownBuiltinKey", {"inspect", "builtin:cornell?sides=3"}, "sides"},
      {"UnknownQuery", {"trace", "builtin:cornell", "--rays", "r.npy", "--hits", "h.npy", "--query", "all"}, "closest and any"},
      {"UnknownRays", {"compare", "builtin:cornell", "--rays", "primary,caustic"}, "primary, diffuse, shadow, random"},
      {"EmptyRays", {"compare", "builtin:cornell", "--rays", "primary,,random"}, "empty entry"},
      {"EmptyStructures", {"compare", "builtin:cornell", "--structures", "bvh;"}, "empty entry"},
      {"UnknownAmongStructures", {"compare", "builtin:cornell", "--structures", "bvh;oak"}, "oak"},
      {"BadMemoryLimit", {"compare", "builtin:cornell", "--memory-limit", "2 cups"}, "2GiB"},
      {"BadSizes", {"compare", "builtin:mount", "--scale", "--sizes", "1k,many"}, "10k"},
      {"SizesOfAComparison", {"compare", "builtin:mount", "--sizes", "1k"}, "--scale"},
      {"ScaleOfAFile", {"compare", "scene.glb", "--scale", "--max", "1k"}, "builtin:mount"},
      {"BadTimeLimit", {"compare", "builtin:cornell", "--time-limit", "0"}, "0.001"},
      {"BadDepths", {"inspect", "builtin:cornell", "--obj", "b.obj", "--depth", "5-2"}, "2-5"},
      {"SeveralWithoutPage", {"inspect", "builtin:cornell", "--structure", "bvh;kdtree"}, "--html"},
      {"SeveralInOneJson", {"inspect", "builtin:cornell", "--structure", "bvh;kdtree", "--json", "i.json"}, "--json is of one structure"},
      {"TooManyOnAPage", {"inspect", "builtin:cornell", "--structure", "bvh;bvh;bvh;bvh;bvh;bvh;bvh", "--html", "i.html"}, "at most 6"},
      {"NoNodesToShow", {"inspect", "builtin:cornell", "--structure", "brute", "--html", "i.html"}, "no nodes"},
      {"ValueForFlag", {"structures", "--json", "file"}, "file"},
  };
  // Numbers, each wrong in the same ways.
  static std::vector<std::string> names;
  const std::vector<std::pair<std::string, std::vector<std::string>>> numbers{
      {"--spp", {"render", "builtin:cornell", "-o", "a.png"}},
      {"--width", {"render", "builtin:cornell", "-o", "a.png"}},
      {"--height", {"render", "builtin:cornell", "-o", "a.png"}},
      {"--threads", {"render", "builtin:cornell", "-o", "a.png"}},
      {"--rounds", {"compare", "builtin:cornell"}},
      {"--count", {"compare", "builtin:cornell"}},
      {"--repeat", {"trace", "builtin:cornell", "--rays", "r.npy", "--hits", "h.npy"}}};
  const std::vector<std::pair<std::string, std::string>> values{
      {"Negative", "-1"}, {"Zero", "0"},       {"Huge", "1e99"}, {"Long", "99999999999999999999999"},
      {"Text", "many"},   {"Fraction", "1.5"}, {"Empty", ""}};
  names.reserve(numbers.size() * values.size());
  for (const auto& [option, start] : numbers) {
    for (const auto& [kind, value] : values) {
      WrongCommand command{names.emplace_back(kind + option.substr(2)).c_str(), start, "whole number from 1 to"};
      command.arguments.push_back(option);
      command.arguments.push_back(value);
      commands.push_back(std::move(command));
    }
  }
  commands.push_back({"NegativeDepth", {"render", "builtin:cornell", "-o", "a.png", "--max-depth", "-1"}, "whole number from 0 to"});
  commands.push_back({"NegativeSeed", {"render", "builtin:cornell", "-o", "a.png", "--seed", "-1"}, "whole number from 0 to"});
  commands.push_back({"HugeExposure", {"render", "builtin:cornell", "-o", "a.png", "--exposure", "1e99"}, "a number from"});
  commands.push_back({"NanExposure", {"render", "builtin:cornell", "-o", "a.png", "--exposure", "nan"}, "a number from"});
  return commands;
}

INSTANTIATE_TEST_SUITE_P(All, WrongCommandTest, ::testing::ValuesIn(wrong_commands()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace grove::testing
