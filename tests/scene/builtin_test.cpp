#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>

#include "grove/base/random.h"
#include "grove/scene/load.h"
#include "scene/temporary_file.h"

namespace grove {
namespace {

using testing::HasSubstr;

const char* const kNames[] = {"cornell", "gears",       "lanterns", "mount",   "rings", "shatter",
                              "soup",    "sphereflake", "spheres",  "stadium", "tree",  "twist"};

std::uint64_t hash(const Scene& scene) {
  std::uint64_t h = 0;
  const auto add = [&](const auto& v) {
    for (int i = 0; i < v.length(); ++i) h = mix_bits(h ^ std::bit_cast<std::uint32_t>(v[i]));
  };
  for (const Object& object : scene.objects) {
    if (const auto* const mesh = std::get_if<std::shared_ptr<TriangleMesh>>(&object.geometry)) {
      for (const Vec3& v : (*mesh)->vertices()) add(v);
      for (const Triangle& t : (*mesh)->triangles()) add(t);
    } else {
      const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(object.geometry);
      for (std::size_t i = 0; i < spheres.size(); ++i) add(Vec4(spheres.sphere(i).centre, spheres.sphere(i).radius));
    }
  }
  return h;
}

std::uint64_t count(const std::string& request) {
  return make_builtin_scene(request).primitive_count();
}

std::string usage_error_of(const std::string& request) {
  try {
    (void)make_builtin_scene(request);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no UsageError";
  return "";
}

TEST(Builtin, EachIsValidLitAndLookedAt) {
  for (const char* name : kNames) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(std::string("builtin:") + name);
    EXPECT_EQ(scene.cameras.size(), 1U);
    bool lit = scene.environment.is_on() || !scene.lights.empty();
    for (const Material& material : scene.materials) lit = lit || material.is_emissive();
    EXPECT_TRUE(lit);
    EXPECT_TRUE(scene.warnings.empty());
    const Box bounds = scene.bounds();
    EXPECT_TRUE(std::isfinite(glm::length(bounds.extent())));
  }
}

// The counts that README.md beside the generators states.
TEST(Builtin, CountsAreAsDocumented) {
  EXPECT_EQ(count("cornell"), 32U);
  EXPECT_EQ(count("cornell?size=3&objects=spheres"), 12U * 9 + 2);
  EXPECT_EQ(count("gears?size=3&teeth=16"), 32U * 16 * 9 + 4);
  EXPECT_EQ(count("lanterns?size=3&lights=5"), 10U * 9 + 2 + 8 * 5);
  EXPECT_EQ(count("lanterns?size=3&lights=5&kind=points"), 10U * 9 + 2);
  EXPECT_EQ(make_builtin_scene("lanterns?lights=5&kind=spots").lights.size(), 5U);
  EXPECT_EQ(count("shatter?size=5"), 12U * 25);
  EXPECT_EQ(count("twist?size=5"), 128U * 25 + 2);
  EXPECT_EQ(count("mount?size=20"), 804U);
  EXPECT_EQ(count("mount?size=20&spheres=false"), 800U);
  EXPECT_EQ(count("rings?size=2&detail=5"), 24U * 25 * 5 + 2);
  EXPECT_EQ(count("soup?size=123"), 123U);
  EXPECT_EQ(count("sphereflake"), 7381U + 2);
  EXPECT_EQ(count("sphereflake?size=2&tessellate=true"), 91U * 80 + 2);
  EXPECT_EQ(count("sphereflake?size=1&shape=triangles&detail=0"), 10U * 20 + 2);
  EXPECT_EQ(count("spheres?size=77"), 77U);
  EXPECT_EQ(count("spheres?size=77&shape=triangles&detail=0"), 77U * 20);
  EXPECT_EQ(count("stadium?size=10"), 1600U + 296);
  EXPECT_EQ(count("tree?size=3&leaves=5"), 28U * 40 + 10 * 27 + 2);
}

TEST(Builtin, ComesNearAWantedCount) {
  for (const char* name : kNames) {
    if (std::string(name) == "sphereflake") continue;  // analytic: nine times as many from one depth to the next
    for (const std::uint64_t wanted : {10'000U, 50'000U, 200'000U}) {
      for (const char* key : {"triangles", "primitives"}) {
        const std::string request = std::string(name) + "?" + key + "=" + std::to_string(wanted);
        EXPECT_NEAR(static_cast<double>(count(request)) / static_cast<double>(wanted), 1.0, 0.1) << request;
      }
    }
  }
  EXPECT_EQ(count("sphereflake?primitives=10000"), 7383U);
  EXPECT_EQ(count("soup?triangles=1000"), 1000U);
}

TEST(Builtin, IsTheSameOnEveryMachine) {
  for (const char* request :
       {"cornell?size=2", "gears?size=2", "mount?size=50", "mount?size=50&seed=2", "rings?size=1", "soup?size=100", "soup?size=100&seed=2",
        "sphereflake?size=2", "spheres?size=100", "spheres?size=100&layout=clustered", "stadium?size=8", "tree?size=3"}) {
    EXPECT_EQ(hash(make_builtin_scene(request)), hash(make_builtin_scene(request))) << request;
  }
  // Made of sums, products and roots only, so that these are known once and for all.
  EXPECT_EQ(hash(make_builtin_scene("mount?size=50&spheres=false")), 5267915957466665910ULL);
  EXPECT_EQ(hash(make_builtin_scene("soup?size=1000")), 3480459409838531550ULL);
}

TEST(Builtin, SeedsMatter) {
  for (const char* name : {"mount?size=20", "soup?size=20", "spheres?size=20", "tree?size=2"}) {
    const std::string request = name;
    EXPECT_EQ(hash(make_builtin_scene(request)), hash(make_builtin_scene(request + "&seed=1")));
    EXPECT_NE(hash(make_builtin_scene(request)), hash(make_builtin_scene(request + "&seed=2")));
  }
}

// A thousand times more spheres fill the same part of the cube.
TEST(Builtin, SpheresKeepTheirVolume) {
  const auto volume = [](const std::string& request) {
    const Scene scene = make_builtin_scene(request);
    const SphereSet& spheres = *std::get<std::shared_ptr<SphereSet>>(scene.objects[0].geometry);
    return static_cast<double>(spheres.size()) * std::pow(static_cast<double>(spheres.sphere(0).radius), 3.0);
  };
  EXPECT_NEAR(volume("spheres?size=50") / volume("spheres?size=50000"), 1.0, 1e-4);
  EXPECT_NEAR(volume("spheres?size=50&layout=clustered") / volume("spheres?size=50"), 1.0, 1e-6);
}

// Closed meshes: each edge belongs to two triangles, once in each direction.
TEST(Builtin, TessellatedSpheresFaceOutward) {
  const Scene scene = make_builtin_scene("spheres?size=1&shape=triangles&detail=2");
  const TriangleMesh& mesh = *std::get<std::shared_ptr<TriangleMesh>>(scene.objects[0].geometry);
  Vec3 centre(0.0F);
  for (const Vec3& v : mesh.vertices()) centre += v / static_cast<float>(mesh.vertices().size());
  for (const Triangle& t : mesh.triangles()) {
    const Vec3& a = mesh.vertices()[t.x];
    EXPECT_GT(glm::dot(glm::cross(mesh.vertices()[t.y] - a, mesh.vertices()[t.z] - a), a - centre), 0.0F);
  }
}

TEST(Builtin, RefusesWhatItDoesNotKnowAndListsWhatItDoes) {
  EXPECT_THAT(usage_error_of("teapot"),
              HasSubstr("cornell, gears, lanterns, mount, rings, shatter, soup, sphereflake, spheres, stadium, tree, twist"));
  EXPECT_THAT(usage_error_of(""), HasSubstr("allowed are cornell"));
  EXPECT_THAT(usage_error_of("cornell?colour=red"), HasSubstr("unknown key 'colour'; allowed are size, triangles, primitives, objects"));
  EXPECT_THAT(usage_error_of("cornell?objects=cubes"), HasSubstr("allowed are blocks, spheres"));
  EXPECT_THAT(usage_error_of("mount?size=0"), HasSubstr("from 1 to 10000"));
  EXPECT_THAT(usage_error_of("mount?size=10x"), HasSubstr("'10x'"));
  EXPECT_THAT(usage_error_of("mount?size=-1"), HasSubstr("'-1'"));
  EXPECT_THAT(usage_error_of("mount?size="), HasSubstr("''"));
  EXPECT_THAT(usage_error_of("mount?size"), HasSubstr("key=value"));
  EXPECT_THAT(usage_error_of("mount?size=1&size=2"), HasSubstr("twice"));
  EXPECT_THAT(usage_error_of("mount?size=1&triangles=2"), HasSubstr("give one"));
  EXPECT_THAT(usage_error_of("soup?triangles=999999999999"), HasSubstr("200000000"));
  EXPECT_THAT(usage_error_of("sphereflake?size=7&tessellate=true&detail=5"), HasSubstr("200000000"));
  EXPECT_THAT(usage_error_of("sphereflake?tessellate=yes"), HasSubstr("true, false"));
  EXPECT_THAT(usage_error_of("gears?teeth=10"), HasSubstr("multiples of 4"));
  for (const char* name : kNames) EXPECT_THAT(usage_error_of(std::string(name) + "?x=1"), HasSubstr("allowed are size"));
}

TEST(Builtin, WhatMovesKeepsItsTriangles) {
  for (const std::string& name : moving_builtin_scenes()) {
    SCOPED_TRACE(name);
    const Scene first = make_builtin_scene(name + "?size=3");
    const Scene start = make_builtin_scene(name + "?size=3&time=0");
    const Scene middle = make_builtin_scene(name + "?size=3&time=0.5");
    EXPECT_EQ(hash(first), hash(start));
    EXPECT_NE(hash(first), hash(middle));
    const TriangleMesh& a = *std::get<std::shared_ptr<TriangleMesh>>(first.objects[0].geometry);
    const TriangleMesh& b = *std::get<std::shared_ptr<TriangleMesh>>(middle.objects[0].geometry);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.triangles()[i], b.triangles()[i]);
    EXPECT_EQ(first.objects.size(), 1U);
  }
  EXPECT_THAT(usage_error_of("twist?time=1.5"), HasSubstr("allowed are numbers from 0 to 1"));
  EXPECT_THAT(usage_error_of("tree?time=0.5"), HasSubstr("unknown key"));
}

}  // namespace
}  // namespace grove
