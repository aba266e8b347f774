// Curves as tessellated tubes (flat and cylinder) or strips (ribbon). pbrt turns flat curves toward the ray; a thin tube looks the same
// from every side. The frames along a tube follow
//   Wang, Juettler, Zheng, Liu 2008, "Computation of Rotation Minimizing Frames" (the double reflection method).

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "grove/scene/pbrt/shapes.h"

namespace grove::pbrt {
namespace {

using Bezier = std::array<Vec3, 4>;

// A ring for every 15 degrees that the control polygon of a segment turns; more than 16 cannot be told apart at the width of a curve.
constexpr float kTurnPerRing = kPi / 12.0F;
constexpr std::uint32_t kMaxRingsPerSegment = 16;
constexpr std::uint32_t kCylinderSides = 6;
constexpr std::uint32_t kFlatSides = 4;

struct Ring {
  Vec3 centre{0.0F};
  Vec3 tangent{0.0F};
  float width = 0.0F;
  float u = 0.0F;  ///< along the whole curve
  std::uint32_t segment = 0;
  float t = 0.0F;  ///< within the segment
};

Bezier elevate(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {a, a + (2.0F / 3.0F) * (b - a), c + (2.0F / 3.0F) * (b - c), c};
}

std::vector<Bezier> bezier_segments(const std::vector<Vec3>& p, std::size_t degree, const Place& place) {
  if (p.size() <= degree || (p.size() - 1) % degree != 0)
    place.fail("a bezier curve of degree " + std::to_string(degree) + " takes a multiple of " + std::to_string(degree) +
               " points and one more, not " + std::to_string(p.size()));
  std::vector<Bezier> segments;
  for (std::size_t i = 0; i + degree < p.size(); i += degree) {
    segments.push_back(degree == 3 ? Bezier{p[i], p[i + 1], p[i + 2], p[i + 3]} : elevate(p[i], p[i + 1], p[i + 2]));
  }
  return segments;
}

// Uniform B-splines; each piece in Bezier form by its blossom.
std::vector<Bezier> bspline_segments(const std::vector<Vec3>& p, std::size_t degree, const Place& place) {
  if (p.size() <= degree)
    place.fail("a bspline curve of degree " + std::to_string(degree) + " takes " + std::to_string(degree + 1) + " points or more, not " +
               std::to_string(p.size()));
  std::vector<Bezier> segments;
  for (std::size_t i = 0; i + degree < p.size(); ++i) {
    if (degree == 2) {
      segments.push_back(elevate(0.5F * (p[i] + p[i + 1]), p[i + 1], 0.5F * (p[i + 1] + p[i + 2])));
    } else {
      segments.push_back({(p[i] + 4.0F * p[i + 1] + p[i + 2]) / 6.0F, (2.0F * p[i + 1] + p[i + 2]) / 3.0F,
                          (p[i + 1] + 2.0F * p[i + 2]) / 3.0F, (p[i + 1] + 4.0F * p[i + 2] + p[i + 3]) / 6.0F});
    }
  }
  return segments;
}

Vec3 evaluate(const Bezier& b, float t) {
  const float s = 1.0F - t;
  return s * s * s * b[0] + 3.0F * s * s * t * b[1] + 3.0F * s * t * t * b[2] + t * t * t * b[3];
}

bool normalise(Vec3& v) {
  const float length = glm::length(v);
  if (!(length > 0.0F) || !std::isfinite(length)) return false;
  v /= length;
  return true;
}

// The derivative's direction, or where it vanishes the chord's; false for a segment that is one point.
bool tangent_at(const Bezier& b, float t, Vec3& tangent) {
  const float s = 1.0F - t;
  tangent = s * s * (b[1] - b[0]) + 2.0F * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]);
  if (normalise(tangent)) return true;
  tangent = b[3] - b[0];
  return normalise(tangent);
}

std::uint32_t ring_count(const Bezier& b) {
  float turn = 0.0F;
  Vec3 before(0.0F);
  bool has_before = false;
  for (int i = 0; i < 3; ++i) {
    Vec3 leg = b[i + 1] - b[i];
    if (!normalise(leg)) continue;
    if (has_before) turn += std::acos(std::clamp(glm::dot(before, leg), -1.0F, 1.0F));
    before = leg;
    has_before = true;
  }
  return std::clamp(static_cast<std::uint32_t>(std::ceil(turn / kTurnPerRing)), 1U, kMaxRingsPerSegment);
}

std::vector<Ring> place_rings(const std::vector<Bezier>& segments, float width_first, float width_last) {
  std::vector<Ring> rings;
  for (std::uint32_t segment = 0; segment < segments.size(); ++segment) {
    const Bezier& b = segments[segment];
    const std::uint32_t count = ring_count(b);
    for (std::uint32_t k = segment == 0 ? 0 : 1; k <= count; ++k) {
      Ring ring;
      ring.t = static_cast<float>(k) / static_cast<float>(count);
      ring.segment = segment;
      ring.centre = evaluate(b, ring.t);
      ring.u = (static_cast<float>(segment) + ring.t) / static_cast<float>(segments.size());
      ring.width = (1.0F - ring.u) * width_first + ring.u * width_last;
      if (!tangent_at(b, ring.t, ring.tangent)) continue;
      if (!rings.empty() && rings.back().centre == ring.centre) continue;
      rings.push_back(ring);
    }
  }
  return rings;
}

// Any unit vector at right angles to a unit vector.
Vec3 perpendicular(const Vec3& v) {
  const Vec3 axis = std::abs(v.x) < 0.6F ? Vec3(1.0F, 0.0F, 0.0F) : Vec3(0.0F, 1.0F, 0.0F);
  return glm::normalize(glm::cross(v, axis));
}

// The reference vector of the next frame, by two reflections (Wang et al. 2008, algorithm 1).
Vec3 carry_frame(const Vec3& reference, const Ring& from, const Ring& to) {
  const Vec3 v1 = to.centre - from.centre;
  const float c1 = glm::dot(v1, v1);
  if (!(c1 > 0.0F)) return perpendicular(to.tangent);
  const Vec3 reflected = reference - (2.0F / c1) * glm::dot(v1, reference) * v1;
  const Vec3 tangent = from.tangent - (2.0F / c1) * glm::dot(v1, from.tangent) * v1;
  const Vec3 v2 = to.tangent - tangent;
  const float c2 = glm::dot(v2, v2);
  Vec3 carried = c2 > 1e-12F ? reflected - (2.0F / c2) * glm::dot(v2, reflected) * v2 : reflected;
  // Rounding adds up over long curves.
  carried -= glm::dot(carried, to.tangent) * to.tangent;
  return normalise(carried) ? carried : perpendicular(to.tangent);
}

void append_strips(ShapeMesh& mesh, std::size_t ring_count, std::uint32_t per_ring, bool closed) {
  const std::uint32_t strips = closed ? per_ring : per_ring - 1;
  for (std::size_t ring = 0; ring + 1 < ring_count; ++ring) {
    const auto first = static_cast<std::uint32_t>(ring * per_ring);
    for (std::uint32_t i = 0; i < strips; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % per_ring;
      mesh.triangles.emplace_back(a, b, b + per_ring);
      mesh.triangles.emplace_back(a, b + per_ring, a + per_ring);
    }
  }
}

ShapeMesh make_tube(const std::vector<Ring>& rings, std::uint32_t sides) {
  ShapeMesh mesh;
  Vec3 reference = perpendicular(rings.front().tangent);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Ring& ring = rings[i];
    if (i > 0) reference = carry_frame(reference, rings[i - 1], ring);
    const Vec3 other = glm::cross(ring.tangent, reference);
    for (std::uint32_t side = 0; side < sides; ++side) {
      const float angle = 2.0F * kPi * static_cast<float>(side) / static_cast<float>(sides);
      const Vec3 outward = std::cos(angle) * reference + std::sin(angle) * other;
      mesh.vertices.push_back(ring.centre + 0.5F * ring.width * outward);
      mesh.normals.push_back(outward);
      // v across the width as seen from one side, so that it has no seam.
      mesh.uvs.emplace_back(ring.u, 0.5F + 0.5F * std::cos(angle));
    }
  }
  append_strips(mesh, rings.size(), sides, true);
  return mesh;
}

Vec3 interpolate_direction(const Vec3& a, const Vec3& b, float t) {
  const float angle = std::acos(std::clamp(glm::dot(a, b), -1.0F, 1.0F));
  if (angle < 1e-3F || angle > kPi - 1e-3F) return (1.0F - t) * a + t * b;
  return (std::sin((1.0F - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

ShapeMesh make_ribbon(const std::vector<Ring>& rings, std::vector<Vec3> normals) {
  for (Vec3& normal : normals) normalise(normal);
  ShapeMesh mesh;
  for (const Ring& ring : rings) {
    const Vec3 facing = interpolate_direction(normals[ring.segment], normals[ring.segment + 1], ring.t);
    Vec3 across = glm::cross(facing, ring.tangent);
    if (!normalise(across)) across = perpendicular(ring.tangent);
    const Vec3 normal = glm::cross(ring.tangent, across);
    for (const float side : {-0.5F, 0.5F}) {
      mesh.vertices.push_back(ring.centre + side * ring.width * across);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(ring.u, side + 0.5F);
    }
  }
  append_strips(mesh, rings.size(), 2, false);
  return mesh;
}

}  // namespace

ShapeMesh make_curve(const ParameterList& parameters, Context& context) {
  const Place& place = parameters.place();
  const std::vector<Vec3> points = parameters.vectors3("P");
  const std::int32_t degree = parameters.integer("degree", 3);
  if (degree != 2 && degree != 3) place.fail("a curve has degree 2 or 3, not " + std::to_string(degree));
  const std::string basis = parameters.text("basis", "bezier");
  if (basis != "bezier" && basis != "bspline") place.fail("the basis of a curve is bezier or bspline, not \"" + basis + "\"");
  const std::string type = parameters.text("type", "flat");
  if (type != "flat" && type != "cylinder" && type != "ribbon")
    place.fail("the type of a curve is flat, cylinder or ribbon, not \"" + type + "\"");
  const float width = parameters.number("width", 1.0F);
  const float width_first = parameters.number("width0", width);
  const float width_last = parameters.number("width1", width);
  parameters.ignore("splitdepth");  // how finely pbrt cuts the curve up; we choose by its bends

  const auto size = static_cast<std::size_t>(degree);
  const std::vector<Bezier> segments = basis == "bezier" ? bezier_segments(points, size, place) : bspline_segments(points, size, place);
  const std::vector<Ring> rings = place_rings(segments, width_first, width_last);
  std::vector<Vec3> normals = parameters.vectors3("N");
  if (type == "ribbon" && normals.size() != segments.size() + 1)
    place.fail("a ribbon of " + std::to_string(segments.size()) + " segments takes " + std::to_string(segments.size() + 1) +
               " normals, not " + std::to_string(normals.size()));
  if (rings.size() < 2) {
    context.warnings.add(place, "a curve without length is left out");
    return {};
  }
  if (type == "ribbon") return make_ribbon(rings, std::move(normals));
  return make_tube(rings, type == "cylinder" ? kCylinderSides : kFlatSides);
}

}  // namespace grove::pbrt
