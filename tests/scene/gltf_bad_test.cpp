#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "grove/base/error.h"
#include "grove/base/random.h"
#include "grove/scene/load.h"
#include "scene/gltf_file.h"

namespace grove {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

std::filesystem::path test_file() {
  std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::replace(name.begin(), name.end(), '/', '_');
  return std::filesystem::path(::testing::TempDir()) / ("grove_bad_" + name + ".glb");
}

Scene load_bytes(const std::string& bytes) {
  const std::filesystem::path file = test_file();
  std::ofstream(file, std::ios::binary) << bytes;
  Scene scene = load_gltf(file);
  std::filesystem::remove(file);
  return scene;
}

std::string error_of(const std::string& bytes) {
  try {
    (void)load_bytes(bytes);
  } catch (const InputError& error) {
    std::filesystem::remove(test_file());
    return error.what();
  }
  return "no error";
}

GltfFile triangle_file() {
  GltfFile file;
  file.add_node({{"mesh", file.add_triangle()}});
  return file;
}

/// A whole file, what to break in it, and what the message must say.
struct Fault {
  const char* name;
  std::function<void(GltfFile&)> damage;
  const char* message;
};

class BadGltf : public ::testing::TestWithParam<Fault> {};

TEST_P(BadGltf, OneClearLine) {
  GltfFile file = triangle_file();
  GetParam().damage(file);
  const std::string message = error_of(file.glb());
  EXPECT_THAT(message, AllOf(HasSubstr(".glb"), HasSubstr(GetParam().message), Not(HasSubstr("\n"))));
}

Json& position(GltfFile& file) {
  return file.json["accessors"][0];
}
Json& primitive(GltfFile& file) {
  return file.json["meshes"][0]["primitives"][0];
}

INSTANTIATE_TEST_SUITE_P(
    Faults, BadGltf,
    ::testing::Values(
        Fault{"index_past_the_vertices", [](GltfFile& f) { f.binary[f.binary.size() - 2] = 7; }, "indices: index 7, but there are only 3"},
        Fault{"accessor_past_the_view", [](GltfFile& f) { position(f)["count"] = 4; }, "accessors[0]: its 4 elements reach past the end"},
        Fault{"absurd_count", [](GltfFile& f) { position(f)["count"] = 4e15; }, "reach past the end"},
        Fault{"absurd_count_without_bytes",
              [](GltfFile& f) {
                position(f).erase("bufferView");
                position(f)["count"] = 4e9;
                primitive(f).erase("indices");
              },
              "times its size in memory"},
        Fault{"more_vertices_than_indices_reach",
              [](GltfFile& f) {
                position(f).erase("bufferView");
                position(f)["count"] = 4e15;
              },
              "2^32 - 2 vertices"},
        Fault{"negative_count", [](GltfFile& f) { position(f)["count"] = -3; }, "accessors[0].count: expected a whole number"},
        Fault{"fractional_count", [](GltfFile& f) { position(f)["count"] = 2.5; }, "accessors[0].count: expected a whole number"},
        Fault{"unaligned_offset_past_the_end", [](GltfFile& f) { position(f)["byteOffset"] = 1; }, "reach past the end"},
        Fault{"view_past_the_buffer", [](GltfFile& f) { f.json["bufferViews"][0]["byteLength"] = 4000; }, "bufferViews[0]: reaches past"},
        Fault{"view_offset_that_overflows", [](GltfFile& f) { f.json["bufferViews"][0]["byteOffset"] = 9e15; }, "bufferViews[0]"},
        Fault{"stride_below_the_element", [](GltfFile& f) { f.json["bufferViews"][0]["byteStride"] = 4; }, "byteStride: is smaller"},
        Fault{"no_such_accessor", [](GltfFile& f) { primitive(f)["attributes"]["POSITION"] = 9; }, "POSITION: names number 9 of 2 accessors"},
        Fault{"no_such_view", [](GltfFile& f) { position(f)["bufferView"] = 9; }, "accessors[0].bufferView: names number 9"},
        Fault{"no_such_buffer", [](GltfFile& f) { f.json["bufferViews"][0]["buffer"] = 1; }, "bufferViews[0].buffer: names number 1"},
        Fault{"no_such_mesh", [](GltfFile& f) { f.json["nodes"][0]["mesh"] = 3; }, "nodes[0].mesh: names number 3 of 1 meshes"},
        Fault{"no_such_node", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = {5}; }, "scenes[0].nodes[0]: names number 5"},
        Fault{"no_such_child", [](GltfFile& f) { f.json["nodes"][0]["children"] = {5}; }, "nodes[0].children[0]"},
        Fault{"no_such_material", [](GltfFile& f) { primitive(f)["material"] = 0; }, "material: names number 0 of 0"},
        Fault{"no_such_scene", [](GltfFile& f) { f.json["scene"] = 4; }, "scene: names number 4 of 1 scenes"},
        Fault{"no_position", [](GltfFile& f) { primitive(f)["attributes"].erase("POSITION"); }, "POSITION: is missing"},
        Fault{"wrong_component_type", [](GltfFile& f) { position(f)["componentType"] = 5124; }, "not a component type"},
        Fault{"wrong_type", [](GltfFile& f) { position(f)["type"] = "VEC2"; }, "has 2 components where"},
        Fault{"unknown_type", [](GltfFile& f) { position(f)["type"] = "VEC9\nx"; }, "accessors[0].type"},
        Fault{"float_indices", [](GltfFile& f) { f.json["accessors"][1]["componentType"] = 5126; f.json["accessors"][1]["count"] = 1; },
              "must be an unsigned integer"},
        Fault{"unknown_mode", [](GltfFile& f) { primitive(f)["mode"] = 17; }, "mode: is 17"},
        Fault{"attributes_of_another_length",
              [](GltfFile& f) { primitive(f)["attributes"]["NORMAL"] = f.add(std::vector<Vec3>(2, Vec3(1.0F))); }, "has 2 values for 3"},
        Fault{"its_own_child", [](GltfFile& f) { f.json["nodes"][0]["children"] = {0}; }, "can be reached twice"},
        Fault{"two_nodes_in_a_ring",
              [](GltfFile& f) {
                f.json["nodes"][0]["children"] = {1};
                f.add_child({{"children", {0}}});
              },
              "can be reached twice"},
        Fault{"two_parents",
              [](GltfFile& f) {
                f.add_node({{"children", {0}}});
              },
              "can be reached twice"},
        Fault{"a_matrix_of_three", [](GltfFile& f) { f.json["nodes"][0]["matrix"] = {1, 2, 3}; }, "nodes[0].matrix: expected 16 numbers"},
        Fault{"text_for_a_number", [](GltfFile& f) { f.json["nodes"][0]["mesh"] = "zero"; }, "nodes[0].mesh: expected a number"},
        Fault{"a_number_for_an_object", [](GltfFile& f) { f.json["meshes"][0] = 5; }, "meshes[0]: expected an object"},
        Fault{"an_object_for_an_array", [](GltfFile& f) { f.json["nodes"] = Json::object(); }, "nodes: expected an array"},
        Fault{"an_extension_that_is_a_number", [](GltfFile& f) { primitive(f)["extensions"] = 1; }, "extensions: expected an object"},
        Fault{"glTF_1", [](GltfFile& f) { f.json["asset"]["version"] = "1.0"; }, "asset.version: is 1.0"},
        Fault{"no_version", [](GltfFile& f) { f.json.erase("asset"); }, "asset.version: is missing"},
        Fault{"nothing_to_show", [](GltfFile& f) { f.json["scenes"][0]["nodes"] = Json::array(); }, "nothing renderable"},
        Fault{"points_only", [](GltfFile& f) { primitive(f)["mode"] = 0; }, "nothing renderable"},
        Fault{"required_extension", [](GltfFile& f) { f.json["extensionsRequired"] = {"EXT_meshopt_compression"}; }, "EXT_meshopt_compression"},
        Fault{"sparse_past_its_view",
              [](GltfFile& f) {
                position(f)["sparse"] = {{"count", 50},
                                         {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                         {"values", {{"bufferView", 0}}}};
              },
              "sparse.indices: reaches past"},
        Fault{"sparse_element_that_is_not_there",
              [](GltfFile& f) {
                const int ids = f.add_view(std::vector<std::uint8_t>{3});
                position(f)["sparse"] = {{"count", 1},
                                         {"indices", {{"bufferView", ids}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", 0}}}};
              },
              "names element 3 of 3"},
        Fault{"draco_that_is_not",
              [](GltfFile& f) {
                primitive(f)["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}};
              },
              "is not Draco data"},
        Fault{"buffer_that_is_not_there",
              [](GltfFile& f) {
                f.json["bufferViews"][0]["buffer"] = 0;
                f.binary.clear();
                f.json["buffers"] = {{{"byteLength", 44}, {"uri", "absent%20file.bin"}}};
              },
              "absent file.bin: no such file"},
        Fault{"buffer_of_the_web",
              [](GltfFile& f) {
                f.binary.clear();
                f.json["buffers"] = {{{"byteLength", 44}, {"uri", "https://example.org/a.bin"}}};
              },
              "only data URIs and paths relative"},
        Fault{"data_uri_that_is_broken",
              [](GltfFile& f) {
                f.binary.clear();
                f.json["buffers"] = {{{"byteLength", 44}, {"uri", "data:;base64,AA*A"}}};
              },
              "broken base64"},
        Fault{"data_uri_that_is_short",
              [](GltfFile& f) {
                f.binary.clear();
                f.json["buffers"] = {{{"byteLength", 44}, {"uri", "data:;base64,AAAA"}}};
              },
              "byteLength: is 44, but there are only 3 bytes"},
        Fault{"a_buffer_for_which_there_is_nothing",
              [](GltfFile& f) {
                f.binary.clear();
                f.json["buffers"] = {{{"byteLength", 44}}};
              },
              "has no uri"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BadGltfContainer, LengthsThatDisagree) {
  const std::string whole = triangle_file().glb();
  EXPECT_EQ(error_of(whole), "no error");
  EXPECT_THAT(error_of(whole.substr(0, whole.size() - 1)), HasSubstr("by its header"));
  EXPECT_THAT(error_of(whole.substr(0, 8)), HasSubstr("cut short"));
  std::string damaged = whole;
  damaged.replace(12, 4, GltfFile::u32(0xfffffff0));
  EXPECT_THAT(error_of(damaged), HasSubstr("a chunk of 4294967280 bytes where"));
  damaged = whole;
  damaged[4] = 1;
  EXPECT_THAT(error_of(damaged), HasSubstr("GLB version 1"));
  damaged = whole;
  damaged.replace(16, 4, "BIN ");
  EXPECT_THAT(error_of(damaged), HasSubstr("first chunk of a GLB must be JSON"));
}

TEST(BadGltfContainer, TextThatIsNotJson) {
  EXPECT_THAT(error_of(""), HasSubstr("not a glTF file"));
  EXPECT_THAT(error_of("solid stl"), HasSubstr("not a glTF file"));
  EXPECT_THAT(error_of("{\"asset\": {\"version\": \"2.0\""), HasSubstr("line 1"));
  EXPECT_THAT(error_of("[]"), HasSubstr("not an object"));
  EXPECT_THAT(error_of(std::string(1000000, '[')), HasSubstr("nested deeper"));
  EXPECT_THAT(error_of("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"scale\": [1e309, 1, 1]}]}"), HasSubstr("number overflow"));
}

TEST(BadGltfContainer, BytesAfterTheEndBelongToNobody) {
  EXPECT_EQ(load_bytes(triangle_file().glb() + "more").primitive_count(), 1U);
}

TEST(BadGltfScene, NodesThatAreNotFiniteAreLeftOut) {
  GltfFile file = triangle_file();
  const int far = file.add_child({{"mesh", file.add_triangle()}, {"scale", {1e30, 1e30, 1e30}}});
  file.add_node({{"scale", {1e30, 1, 1}}, {"children", {far}}});
  const Scene scene = load_bytes(file.glb());
  EXPECT_EQ(scene.primitive_count(), 1U);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("not finite are left out, such as nodes[1]")));
}

TEST(BadGltfScene, InfiniteVerticesAreAWarning) {
  GltfFile file = triangle_file();
  const int position = file.add(std::vector<Vec3>{{0, 0, 0}, {1, 0, std::numeric_limits<float>::infinity()}, {0, 1, 0}});
  file.add_node({{"mesh", file.add_mesh({{"attributes", {{"POSITION", position}}}})}});
  const Scene scene = load_bytes(file.glb());
  EXPECT_EQ(scene.bounds().upper, Vec3(1, 1, 0));
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("not finite cannot be hit, such as in meshes[1].primitives[0]")));
}

TEST(BadGltfScene, ADeepChainOfNodes) {
  GltfFile file = triangle_file();
  int child = file.add_child({{"mesh", file.add_triangle()}});
  for (int i = 0; i < 20000; ++i) child = file.add_child({{"children", {child}}});
  file.json["scenes"][0]["nodes"].push_back(child);
  EXPECT_EQ(load_bytes(file.glb()).primitive_count(), 2U);
}

// Ten thousand primitives over one array would grow a file of a megabyte to gigabytes.
TEST(BadGltfScene, AnArrayUsedTooOftenIsAnError) {
  GltfFile file = triangle_file();
  const int position = file.add(std::vector<Vec3>(30000));
  Json primitives = Json::array();
  for (int i = 0; i < 10000; ++i) primitives.push_back({{"attributes", {{"POSITION", position}}}});
  file.json["meshes"][0]["primitives"] = primitives;
  EXPECT_THAT(error_of(file.glb()), HasSubstr("uses its arrays too often"));
}

TEST(BadGltfScene, InstancesWithoutVolumeAreLeftOut) {
  GltfFile file = triangle_file();
  file.add_node({{"mesh", 0}, {"scale", {0, 0, 0}}});
  const Scene scene = load_bytes(file.glb());
  EXPECT_EQ(scene.instances.size(), 1U);
  EXPECT_THAT(scene.warnings, Contains(HasSubstr("scaled to nothing")));
}

class SharedBadGltf : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(GROVE_SOURCE_DIR) / ".." / "shared" / "scenes";
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << "no ../shared/scenes beside the source tree";
  }

  std::string error_of_shared(const std::string& name) const {
    try {
      (void)load_gltf(folder_ / "bad" / name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(SharedBadGltf, EachFileGivesAClearLineOrAScene) {
  const std::vector<std::pair<const char*, const char*>> expected = {{"truncated_chunk_data.glb", "48 bytes by its header, 47 by its size"},
                                                                     {"length_mismatch.glb", "49 bytes by its header, 48 by its size"},
                                                                     {"chunk_too_big.glb", "cut short"},
                                                                     {"node_loop_scene.gltf", "can be reached twice"},
                                                                     {"RecursiveNodes.gltf", "can be reached twice"},
                                                                     {"infinite_transform.gltf", "number overflow"},
                                                                     {"invalid_length.gltf", "nothing renderable"},
                                                                     {"index_buffer_degenerate_triangle.gltf", "nothing renderable"},
                                                                     {"IndexOutOfRange.gltf", "but there are only"},
                                                                     {"missing_bin.gltf", "no such file"},
                                                                     {"BoxWithInfinites.glb", "nothing renderable"}};
  for (const auto& [name, message] : expected) EXPECT_THAT(error_of_shared(name), HasSubstr(message)) << name;
}

std::string damaged(std::string bytes, Random& random) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  // Half of the flips go where the structure is: the headers and the JSON.
  const std::uint32_t focus = std::min(size, 12000U);
  const std::uint32_t flips = 1 + random.next_u32(6);
  for (std::uint32_t i = 0; i < flips; ++i) {
    const std::uint32_t at = random.next_u32(random.next_u32(2) == 0 ? focus : size);
    // A digit for a digit keeps the JSON whole and makes its numbers lie.
    const bool digit = bytes[at] >= '0' && bytes[at] <= '9';
    bytes[at] = static_cast<char>(digit ? '0' + random.next_u32(10) : random.next_u32(256));
  }
  if (random.next_u32(8) == 0) bytes.resize(random.next_u32(size));
  return bytes;
}

// Whatever the damage: a scene or one clear InputError. Under the address sanitiser this finds reads outside the buffers.
TEST_F(SharedBadGltf, DamagedFilesGiveASceneOrAnError) {
  const int variants = fuzz_variants(300);
  std::ifstream stream(folder_ / "animated" / "Fox.glb", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  ASSERT_FALSE(whole.empty());
  constexpr std::uint64_t kSeed = 5;
  Random random(kSeed);
  int scenes = 0;
  for (int variant = 0; variant < variants; ++variant) {
    const std::string bytes = damaged(whole, random);
    try {
      const Scene scene = load_bytes(bytes);
      EXPECT_GT(scene.primitive_count(), 0U);
      ++scenes;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(".glb"), Not(HasSubstr("\n")))) << "seed " << kSeed << ", variant " << variant;
    }
  }
  // Both outcomes must come up, or the damage is too mild or too strong to find anything.
  EXPECT_GT(scenes, 0);
  EXPECT_LT(scenes, variants);
}

}  // namespace
}  // namespace grove
