#include <cmath>

#include "scene/pbrt_file.h"

// Every shape against what it is by definition.

namespace grove {
namespace {

class PbrtShapes : public PbrtTest {
 protected:
  Scene load_shape(std::string_view shape) const { return load("WorldBegin\n" + std::string(shape) + "\n"); }

  // Sum of the triangles' areas, and of their signed tetrahedra with the origin.
  static double area(const TriangleMesh& m) {
    double sum = 0.0;
    for (const Triangle& t : m.triangles()) {
      const glm::dvec3 a(m.vertices()[t.x]), b(m.vertices()[t.y]), c(m.vertices()[t.z]);
      sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
  }
  static double volume(const TriangleMesh& m) {
    double sum = 0.0;
    for (const Triangle& t : m.triangles()) {
      const glm::dvec3 a(m.vertices()[t.x]), b(m.vertices()[t.y]), c(m.vertices()[t.z]);
      sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
  }
};

constexpr double kPiD = 3.14159265358979;

TEST_F(PbrtShapes, TriangleMeshKeepsItsAttributes) {
  const Scene scene = load_shape(
      "Rotate 90 0 0 1 Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 2 1 3 ] \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]\n"
      "\"point2 uv\" [ 0 0 1 0 0 1 1 1 ] \"vector3 S\" [ 2 0 0 2 0 0 2 0 0 2 0 0 ]");
  const Part& part = scene.objects.at(0).parts.at(0);
  EXPECT_EQ(mesh(scene).size(), 2U);
  ASSERT_EQ(part.uvs.size(), 4U);
  EXPECT_EQ(part.uvs[1], Vec2(1, 0));
  expect_near(Vec3(part.tangents.at(0)), {0, 1, 0});
  EXPECT_EQ(part.tangents[0].w, 1.0F);
  EXPECT_TRUE(part.normals.empty());
}

TEST_F(PbrtShapes, PlyMeshIsFoundBesideTheScene) {
  write("one.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Scene scene = load_shape("Translate 0 0 4 Shape \"plymesh\" \"string filename\" \"one.ply\"");
  EXPECT_EQ(mesh(scene).size(), 1U);
  expect_near(mesh(scene).vertices()[1], {1, 0, 4});
}

TEST_F(PbrtShapes, RoundSpheresStayAnalytic) {
  const Scene scene = load_shape("Translate 1 2 3 Rotate 30 1 1 0 Scale 2 2 -2 Shape \"sphere\" \"float radius\" 3\nShape \"sphere\"");
  ASSERT_EQ(spheres(scene).size(), 2U);
  EXPECT_EQ(spheres(scene).part_count(), 1U);  // of one material
  expect_near(spheres(scene).sphere(0).centre, {1, 2, 3});
  EXPECT_NEAR(spheres(scene).sphere(0).radius, 6.0F, 1e-5F);
  EXPECT_NEAR(spheres(scene).sphere(1).radius, 2.0F, 1e-5F);
}

TEST_F(PbrtShapes, ReversedSpheresArePartsOfTheirOwn) {
  const Scene scene = load_shape("Shape \"sphere\" ReverseOrientation Shape \"sphere\"");
  ASSERT_EQ(spheres(scene).part_count(), 2U);
  EXPECT_FALSE(scene.objects[0].parts[0].flip_orientation);
  EXPECT_TRUE(scene.objects[0].parts[1].flip_orientation);
}

TEST_F(PbrtShapes, EllipsoidsAreClosedMeshes) {
  const Scene scene = load_shape("Scale 1 2 3 Shape \"sphere\" \"float radius\" 1");
  // An ellipsoid inscribed in facets is a little smaller, and its facets face outward.
  EXPECT_NEAR(volume(mesh(scene)), 4.0 / 3.0 * kPiD * 6.0, 0.2);
  EXPECT_LT(volume(mesh(scene)), 4.0 / 3.0 * kPiD * 6.0);
  const Box box = scene.bounds();
  expect_near(box.upper, {1, 2, 3}, 1e-3F);
  // Normals are the gradient's direction.
  const Part& part = scene.objects[0].parts[0];
  const Vec3 p = mesh(scene).vertices()[40 * 5];
  expect_near(part.normals.at(40 * 5), glm::normalize(Vec3(p.x, p.y / 4.0F, p.z / 9.0F)), 1e-4F);
}

TEST_F(PbrtShapes, MirroredEllipsoidsStillFaceOutward) {
  EXPECT_GT(volume(mesh(load_shape("Scale -1 2 3 Shape \"sphere\""))), 0.0);
  EXPECT_LT(volume(mesh(load_shape("ReverseOrientation Scale 1 2 3 Shape \"sphere\""))), 0.0);
}

TEST_F(PbrtShapes, PartialSpheres) {
  const Scene scene = load_shape("Shape \"sphere\" \"float zmin\" 0 \"float phimax\" 180");
  EXPECT_NEAR(area(mesh(scene)), kPiD, 0.01);  // a quarter of 4 pi
  const Box box = scene.bounds();
  expect_near(box.lower, {-1, 0, 0}, 1e-3F);
  expect_near(box.upper, {1, 1, 1}, 1e-3F);
}

TEST_F(PbrtShapes, Disks) {
  const Scene scene = load_shape("Shape \"disk\" \"float height\" 2 \"float radius\" 3 \"float innerradius\" 1");
  EXPECT_NEAR(area(mesh(scene)), kPiD * 8.0, 0.1);
  EXPECT_EQ(mesh(scene).vertices()[0].z, 2.0F);
  expect_near(scene.objects[0].parts[0].normals[0], {0, 0, 1});
  // v is 0 at the rim.
  EXPECT_EQ(scene.objects[0].parts[0].uvs[0], Vec2(0, 0));
  expect_near(mesh(scene).vertices()[0], {3, 0, 2});
  const Scene whole = load_shape("Shape \"disk\"");
  EXPECT_NEAR(area(mesh(whole)), kPiD, 0.01);
  EXPECT_EQ(mesh(whole).size(), 64U);  // no zero-area triangles at the centre
}

TEST_F(PbrtShapes, Cylinders) {
  const Scene scene = load_shape("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 3");
  EXPECT_NEAR(area(mesh(scene)), 2.0 * kPiD * 2.0 * 4.0, 0.1);
  EXPECT_GT(volume(mesh(scene)), 0.0);
}

TEST_F(PbrtShapes, FlatBilinearPatchesAreTwoTriangles) {
  const Scene scene = load_shape("Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  2 0 0  0 2 0  2 2 0 ]");
  EXPECT_EQ(mesh(scene).size(), 2U);
  EXPECT_NEAR(area(mesh(scene)), 4.0, 1e-5);
  expect_near(scene.objects[0].parts[0].normals.at(0), {0, 0, 1});
  EXPECT_EQ(scene.objects[0].parts[0].uvs.at(3), Vec2(1, 1));
}

TEST_F(PbrtShapes, BentBilinearPatchesAreGrids) {
  const Scene scene = load_shape(
      "Shape \"bilinearmesh\" \"integer indices\" [ 0 1 2 3 ] \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 1 ] \"point2 uv\" [ 0 0 2 0 0 2 2 2 "
      "]");
  EXPECT_EQ(mesh(scene).size(), 512U);
  // The surface is z = x y.
  for (const Vec3& p : mesh(scene).vertices()) EXPECT_NEAR(p.z, p.x * p.y, 1e-6F);
  // Its area is the integral of sqrt(1 + x^2 + y^2) over the unit square, 1.2808.
  EXPECT_NEAR(area(mesh(scene)), 1.2808, 1e-3);
  EXPECT_EQ(scene.objects[0].parts[0].uvs.back(), Vec2(2, 2));
}

TEST_F(PbrtShapes, LoopSubdivisionShowsItsControlMesh) {
  const Scene scene =
      load_shape("Shape \"loopsubdiv\" \"integer levels\" 3 \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 2 ]");
  EXPECT_EQ(mesh(scene).size(), 1U);
  EXPECT_EQ(scene.warnings.size(), 1U);
}

// The distances of a tube's vertices from the segment x in [0, 1] of the x axis.
TEST_F(PbrtShapes, StraightBezierCurvesAreTubes) {
  const Scene scene = load_shape(
      "Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [ 0 0 0  1 0 0  2 0 0  3 0 0 ] \"float width0\" 2 \"float width1\" 1");
  EXPECT_EQ(mesh(scene).size(), 12U);  // straight: two rings of six
  for (const Vec3& p : mesh(scene).vertices()) EXPECT_NEAR(std::hypot(p.y, p.z), p.x == 0.0F ? 1.0F : 0.5F, 1e-5F);
  EXPECT_GT(volume(mesh(scene)), 0.0);  // faces outward
  EXPECT_EQ(scene.objects[0].parts[0].uvs.front().x, 0.0F);
  EXPECT_EQ(scene.objects[0].parts[0].uvs.back().x, 1.0F);
}

TEST_F(PbrtShapes, CubicSplinesRunWhereTheyShould) {
  // A uniform cubic B-spline begins at (p0 + 4 p1 + p2) / 6.
  const Scene spline =
      load_shape("Shape \"curve\" \"string basis\" \"bspline\" \"float width\" 1e-4 \"point3 P\" [ 0 0 0  6 0 0  6 6 0  0 6 0 ]");
  expect_near(mesh(spline).vertices().front(), {5, 1, 0}, 1e-3F);
  expect_near(mesh(spline).vertices().back(), {5, 5, 0}, 1e-3F);
  // A quadratic Bezier curve passes its middle at (p0 + 2 p1 + p2) / 4, a quadratic B-spline begins at (p0 + p1) / 2.
  const Scene quadratic = load_shape("Shape \"curve\" \"integer degree\" 2 \"float width\" 1e-4 \"point3 P\" [ 0 0 0  2 4 0  4 0 0 ]");
  EXPECT_NEAR(quadratic.bounds().upper.y, 2.0F, 0.05F);
  const Scene quadratic_spline = load_shape(
      "Shape \"curve\" \"integer degree\" 2 \"string basis\" \"bspline\" \"float width\" 1e-4 \"point3 P\" [ 0 0 0  2 4 0  4 0 0 ]");
  expect_near(mesh(quadratic_spline).vertices().front(), {1, 2, 0}, 1e-3F);
}

TEST_F(PbrtShapes, RibbonsFaceTheirNormals) {
  const Scene scene = load_shape(
      "Shape \"curve\" \"string type\" \"ribbon\" \"point3 P\" [ 0 0 0  1 0 0  2 0 0  3 0 0 ] \"float width\" 2 \"normal N\" [ 0 0 1  0 0 "
      "1 ]");
  EXPECT_EQ(mesh(scene).size(), 2U);
  EXPECT_NEAR(area(mesh(scene)), 6.0, 1e-4);
  for (const Vec3& normal : scene.objects[0].parts[0].normals) expect_near(normal, {0, 0, 1});
  for (const Vec3& p : mesh(scene).vertices()) EXPECT_NEAR(std::abs(p.y), 1.0F, 1e-5F);
}

TEST_F(PbrtShapes, CurvesWithoutLengthAndUnknownShapesAreLeftOut) {
  const Scene scene = load_world("Shape \"curve\" \"point3 P\" [ 1 1 1 1 1 1 1 1 1 1 1 1 ]\nShape \"heightfield\" \"integer nu\" 2");
  EXPECT_EQ(scene.primitive_count(), 1U);
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:2: a curve without length"));
  EXPECT_TRUE(warns_of(scene, "scene.pbrt:3: the shape \"heightfield\" is not supported"));
}

}  // namespace
}  // namespace grove
