#include <array>
#include <sstream>
#include <vector>

#include "grove/base/random.h"
#include "scene/pbrt_file.h"

// What is wrong with a file is said in one line, with its place; nothing else happens.

namespace grove {
namespace {

class PbrtErrors : public PbrtTest {
 protected:
  void expect_error(std::string_view text, std::string_view expected) const {
    const std::string message = error_of(text);
    EXPECT_NE(message.find(expected), std::string::npos) << "got: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
};

TEST_F(PbrtErrors, OfTheText) {
  expect_error("WorldBegin\nShap \"sphere\"", "scene.pbrt:2: unknown directive \"Shap\"");
  expect_error("WorldBegin\n\n\"sphere\"", "scene.pbrt:3: expected a directive");
  expect_error("WorldBegin Shape \"sphere\n\"", "scene.pbrt:1: a quoted string is not closed");
  expect_error("Shape \"sphere", "scene.pbrt:1: a quoted string is not closed");
  expect_error("Shape \"sphere\\", "scene.pbrt:1: a quoted string is not closed");
  expect_error("Shape 5", "scene.pbrt:1: Shape takes the kind of shape in quotes");
  expect_error("", "nothing renderable");
  expect_error("\x1f\x8b\x08", "gzip");
}

TEST_F(PbrtErrors, OfParameters) {
  expect_error("Shape \"sphere\"\n\"float\" 1", "scene.pbrt:2: expected a parameter such as");
  expect_error("Shape \"sphere\" \"double radius\" 1", "scene.pbrt:1: unknown parameter type \"double\"");
  expect_error("Shape \"sphere\" \"float radius\"", "\"radius\" has no value");
  expect_error("Shape \"sphere\" \"float radius\" [ ]", "\"radius\" has no value");
  expect_error("Shape \"sphere\" \"float radius\" [ 1", "are not closed with ]");
  expect_error("Shape \"sphere\" \"float radius\" [ 1\nShape \"sphere\"", "\"radius\" takes numbers, not \"Shape\"");
  expect_error("Shape \"sphere\" \"float radius\" [ 1 2 ]", "\"radius\" takes one number");
  expect_error("Shape \"sphere\" \"float radius\" 1e999", "\"radius\" must be a finite number");
  expect_error("Shape \"sphere\" \"float radius\" -1", "\"radius\" must be positive");
  expect_error("Shape \"sphere\" \"float radius\" 1x", "takes numbers, not \"1x\"");
  expect_error("Shape \"sphere\" \"bool b\" 1", "takes true or false");
  expect_error("Shape \"sphere\" \"string s\" 1", "takes quoted strings");
  expect_error("Shape \"sphere\" \"integer i\" 99999999999", "takes 32-bit integers");
  expect_error("Shape \"sphere\" \"integer i\" 1.5", "takes 32-bit integers");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 1 2 3 4 ]", "\"P\" has 4 values, which is not a multiple of 3");
  expect_error("WorldBegin Material \"diffuse\" \"rgb reflectance\" [ 1 nan 1 ]\n" + std::string(kTriangle), "must have finite numbers");
  expect_error("WorldBegin Material \"diffuse\" \"spectrum reflectance\" \"nope\"\n" + std::string(kTriangle), "neither a named spectrum");
  expect_error("WorldBegin Material \"diffuse\" \"spectrum reflectance\" [ 500 1 400 1 ]\n" + std::string(kTriangle), "must ascend");
}

TEST_F(PbrtErrors, OfTransforms) {
  expect_error("Translate 1 2", "scene.pbrt:1: Translate takes 3 numbers");
  expect_error("Translate 1 2 x", "scene.pbrt:1: Translate takes 3 numbers");
  expect_error("Transform [ 1 2 3 ]", "Transform takes 16 numbers");
  expect_error("Scale [ 1 1 1 1 ]", "Scale takes 3 numbers, then ]");
  expect_error("ActiveTransform Middle", "ActiveTransform takes");
}

TEST_F(PbrtErrors, OfBlocks) {
  expect_error("WorldBegin\nAttributeEnd", "scene.pbrt:2: AttributeEnd without AttributeBegin");
  expect_error("WorldBegin\nObjectEnd", "scene.pbrt:2: ObjectEnd without ObjectBegin");
  expect_error("AttributeBegin\nTransformEnd", "scene.pbrt:2: TransformEnd inside the AttributeBegin of");
  expect_error("ObjectBegin \"a\" AttributeBegin\nObjectEnd", "scene.pbrt:2: ObjectEnd inside the AttributeBegin of");
  expect_error("WorldBegin\nObjectBegin \"a\"", "scene.pbrt:2: ObjectBegin without ObjectEnd");
  expect_error("ObjectBegin \"a\" ObjectBegin \"b\"", "ObjectBegin inside another");
  expect_error("ObjectBegin \"a\" ObjectEnd ObjectBegin \"a\"", "\"a\" is defined twice");
  expect_error("ObjectBegin \"a\" ObjectInstance \"a\"", "instances cannot be nested");
  expect_error("WorldBegin\nObjectInstance \"a\"", "scene.pbrt:2: no ObjectBegin defines \"a\"");
  expect_error("WorldBegin WorldBegin", "for the second time");
  EXPECT_TRUE(
      warns_of(load("WorldBegin\nAttributeBegin\n" + std::string(kTriangle)), "scene.pbrt:2: a block that begins here is not ended"));
}

TEST_F(PbrtErrors, OfShapes) {
  expect_error("Shape \"trianglemesh\"", "scene.pbrt:1: the mesh has no \"point3 P\"");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n\"integer indices\" [ 0 1 3 ]",
               "scene.pbrt:2: index 3 is out of range");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 -1 2 ]", "index -1 is out of range");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 ]", "not a multiple of 3");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 1 ]", "needs \"integer indices\"");
  expect_error("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\" [ 0 0 1 ]", "\"N\" has 1 entries for 3 points");
  expect_error("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] \"integer indices\" [ 0 1 2 4 ]",
               "index 4 is out of range");
  expect_error("Shape \"plymesh\"", "plymesh has no \"string filename\"");
  expect_error("Shape \"plymesh\" \"string filename\" \"gone.ply\"", "gone.ply");
  expect_error("Shape \"curve\" \"point3 P\" [ 0 0 0 1 1 1 ]",
               "a bezier curve of degree 3 takes a multiple of 3 points and one more, not 2");
  expect_error("Shape \"curve\" \"integer degree\" 7 \"point3 P\" [ 0 0 0 1 1 1 ]", "degree 2 or 3, not 7");
  expect_error("Shape \"curve\" \"string basis\" \"bspline\"", "a bspline curve of degree 3 takes 4 points or more");
}

TEST_F(PbrtErrors, OfSettings) {
  expect_error("Film \"rgb\" \"integer xresolution\" -5", "\"xresolution\" must be between 1 and 65536");
  expect_error("Camera \"perspective\" \"float fov\" 180", "\"fov\" must be above 0 and below 180");
  expect_error("ColorSpace \"cmyk\"", "unknown colour space \"cmyk\"");
  expect_error("Attribute \"everything\" \"float a\" 1", "Attribute takes shape");
  expect_error("Texture \"t\" \"vector\" \"constant\"", "a texture is of float or spectrum");
  expect_error("MakeNamedMaterial \"m\"", "has no \"string type\"");
  expect_error("WorldBegin Material \"mix\"\n" + std::string(kTriangle), "a mix takes \"string materials\"");
  expect_error("WorldBegin MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [ \"m\" \"m\" ] NamedMaterial \"m\"\n" +
                   std::string(kTriangle),
               "in a circle");
}

TEST_F(PbrtErrors, OfMixesThatDouble) {
  std::string text = "WorldBegin MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string below = "\"m" + std::to_string(i - 1) + "\"";
    text += "MakeNamedMaterial \"m" + std::to_string(i) + "\" \"string type\" \"mix\" \"string materials\" [ " + below + below + " ]\n";
    // Wearing each in turn builds them from the bottom up.
    text += "NamedMaterial \"m" + std::to_string(i) + "\"\n" + std::string(kTriangle);
  }
  expect_error(text, "scene.pbrt:26: mixes of mixes are nested more than 8 deep");
}

TEST_F(PbrtErrors, OfIncludes) {
  expect_error("WorldBegin\nInclude \"scene.pbrt\"", "scene.pbrt:2: \"scene.pbrt\" includes itself");
  expect_error("WorldBegin\nInclude \"gone.pbrt\"", "scene.pbrt:2: the file \"gone.pbrt\" is not there");
  expect_error("WorldBegin\nInclude \".\"", "scene.pbrt:2: the file");
  write("broken.pbrt", "\n\nTranslate 1");
  expect_error("WorldBegin Include \"broken.pbrt\"", "broken.pbrt:3: Translate takes 3 numbers");
  write("open.pbrt", "AttributeBegin");
  expect_error("WorldBegin Import \"open.pbrt\"", "does not end the blocks");
  // A chain without a circle, but too deep.
  for (int i = 0; i < 100; ++i) write("deep" + std::to_string(i), "Include \"deep" + std::to_string(i + 1) + "\"");
  expect_error("Include \"deep0\"", "nested more than 64 deep");
  // Thirty files that each include the next one twice: 2^30 in all.
  for (int i = 0; i < 30; ++i) {
    const std::string next = "Include \"twice" + std::to_string(i + 1) + "\"\n";
    write("twice" + std::to_string(i), next + next);
  }
  write("twice30", "");
  expect_error("Include \"twice0\"", "included again and again");
}

TEST_F(PbrtErrors, OfTheSceneThatIncludesItself) {
  const std::filesystem::path file = std::filesystem::path(GROVE_SOURCE_DIR) / "../shared/scenes/bad/include_loop.pbrt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  EXPECT_THROW(load_pbrt(file), InputError);
}

TEST_F(PbrtErrors, NotOfOddCoordinates) {
  const Scene scene = load_world(
      "Shape \"trianglemesh\" \"point3 P\" [ nan inf -inf 1e999 -1e999 1e-999 0 1 0 ] \"normal N\" [ 0 0 0 nan 0 0 1e38 1e38 1e38 ]");
  EXPECT_EQ(scene.primitive_count(), 2U);
  for (const Vec3& normal : scene.objects[0].parts[0].normals) EXPECT_TRUE(std::isfinite(normal.x + normal.y + normal.z));
}

// A scene with a bit of everything.
constexpr std::string_view kSeedScene = R"(
LookAt 0 0 5  0 0 0  0 1 0
Film "rgb" "integer xresolution" [ 64 ] "integer yresolution" [ 48 ]
Camera "perspective" "float fov" [ 40 ]
WorldBegin
LightSource "infinite" "rgb L" [ .5 .5 .5 ]
LightSource "spot" "blackbody I" [ 5000 ] "point3 from" [ 0 3 0 ] "point3 to" [ 0 0 0 ] "float coneangle" 30
Texture "board" "spectrum" "checkerboard" "rgb tex1" [ .1 .2 .3 ] "float uscale" [ 4 ]
Texture "rough" "float" "constant" "float value" .2
MakeNamedMaterial "metal" "string type" "conductor" "spectrum eta" "metal-Au-eta" "texture roughness" "rough"
MakeNamedMaterial "both" "string type" "mix" "string materials" [ "metal" "both2" ]
MakeNamedMaterial "both2" "string type" "diffuse" "texture reflectance" "board"
AttributeBegin
  NamedMaterial "both"
  Translate 1 0 0 Rotate 45 0 1 0 Scale 1 2 1
  Shape "sphere" "float radius" 1
  AreaLightSource "diffuse" "spectrum L" [ 400 1 700 2 ] "float scale" 3
  Shape "disk" "float radius" 2 "float height" 1
AttributeEnd
ObjectBegin "thing"
  Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 1 ] "integer indices" [ 0 1 2 2 1 3 ] "point2 uv" [ 0 0 1 0 0 1 1 1 ]
  Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 1 ]
  Shape "curve" "string type" "ribbon" "point3 P" [ 0 0 0 1 0 0 2 1 0 3 0 0 ] "normal N" [ 0 0 1 0 0 1 ]
ObjectEnd
ObjectInstance "thing"
ConcatTransform [ 1 0 0 0 0 1 0 0 0 0 1 0 5 0 0 1 ]
ObjectInstance "thing"
)";

std::vector<std::string> split_words(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool is_number(const std::string& word) {
  return word.find_first_not_of("0123456789.-") == std::string::npos;
}

// One word is deleted, doubled, swapped with another, replaced, or has a letter changed. Half of the time it is a number that becomes
// another one, so that many variants are still scenes.
void mutate(std::vector<std::string>& words, Random& random) {
  static constexpr std::array<const char*, 8> kOddNumbers{"-1", "0", "1e30", "-1e-30", "3", "nan", "inf", "65536"};
  static constexpr std::array<const char*, 14> kOddWords{"[",    "]",         "\"",   "-1",           "1e999",          "nan", "4294967296",
                                                         "\"\"", "\"texture", "true", "AttributeEnd", "\"scene.pbrt\"", "#",   "0"};
  const auto at = random.next_u32(static_cast<std::uint32_t>(words.size()));
  const auto other = random.next_u32(static_cast<std::uint32_t>(words.size()));
  if (random.next_u32(2) == 0) {
    if (is_number(words[at])) words[at] = kOddNumbers[random.next_u32(kOddNumbers.size())];
    return;
  }
  switch (random.next_u32(5)) {
    case 0:
      words.erase(words.begin() + at);
      break;
    case 1:
      words.insert(words.begin() + other, words[at]);
      break;
    case 2:
      std::swap(words[at], words[other]);
      break;
    case 3:
      words[at] = kOddWords[random.next_u32(kOddWords.size())];
      break;
    default:
      words[at][random.next_u32(static_cast<std::uint32_t>(words[at].size()))] = static_cast<char>(random.next_u32(256));
      break;
  }
}

TEST_F(PbrtErrors, AreAllThatDamagedScenesGive) {
  constexpr std::uint64_t kSeed = 20261122;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Random random(kSeed);
  ASSERT_EQ(error_of(kSeedScene), "");
  int loaded = 0, refused = 0;
  for (int variant = 0; variant < 600; ++variant) {
    std::vector<std::string> words = split_words(kSeedScene);
    for (int i = 0; i <= variant % 3; ++i) mutate(words, random);
    std::string text;
    // Short lines, because a # swallows the rest of one.
    for (std::size_t i = 0; i < words.size(); ++i) text += words[i] + (i % 8 == 7 ? "\n" : " ");
    try {
      load(text);
      ++loaded;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
      ++refused;
    }
  }
  // Both kinds occur, or the variants test nothing.
  EXPECT_GT(loaded, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace grove
