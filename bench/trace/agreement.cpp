#include "trace/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace grove::bench {
namespace {

using Exact = glm::tvec3<long double>;

// Where the ray's line meets the triangle's plane, in extended precision.
struct ExactCrossing {
  long double t = 0.0L;
  long double least_weight = 0.0L;  // the smallest barycentric weight: negative outside, near 0 at an edge
  long double cosine = 0.0L;        // between ray and normal
  long double edge_error = 0.0L;    // how far float rounding of coordinates may move a weight
};

ExactCrossing cross(const TriangleMesh& mesh, std::uint32_t primitive, const Ray& ray) {
  const Triangle& triangle = mesh.triangles()[primitive];
  const Exact v0(mesh.vertices()[triangle.x]);
  const Exact e1 = Exact(mesh.vertices()[triangle.y]) - v0;
  const Exact e2 = Exact(mesh.vertices()[triangle.z]) - v0;
  const Exact d(ray.direction);
  const Exact from = Exact(ray.origin) - v0;
  const Exact n = glm::cross(e1, e2);
  const long double determinant = -glm::dot(n, d);
  ExactCrossing result;
  result.t = glm::dot(n, from) / determinant;
  const Exact q = glm::cross(from, d);
  const long double u = glm::dot(e2, q) / determinant;
  const long double v = -glm::dot(e1, q) / determinant;
  result.least_weight = std::min({u, v, 1.0L - u - v});
  const long double normal_length = glm::length(n);
  result.cosine = std::fabs(determinant) / (normal_length * glm::length(d));
  // A coordinate relative to the origin is off by up to some units of 2^-24; seen at this slant and set against the triangle's height.
  const long double size = glm::length(from) + glm::length(e1) + glm::length(e2);
  const long double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
  const long double height = normal_length / longest;
  result.edge_error = 16.0L * 0x1p-24L * size / (height * std::max(result.cosine, 1e-12L));
  return result;
}

}  // namespace

Agreement compare_hits(const TriangleMesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits, std::span<const Hit> rival_hits) {
  Agreement agreement;
  agreement.rays = rays.size();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = hits[i];
    const Hit& rival = rival_hits[i];
    if (hit) ++agreement.hits;
    if (hit.t == rival.t || std::fabs(hit.t - rival.t) <= 1e-4F * std::min(hit.t, rival.t)) {
      ++agreement.agreeing;
      continue;
    }
    if (hit.primitive == rival.primitive) {
      const ExactCrossing exact = cross(mesh, hit.primitive, rays[i]);
      if (std::fabs(hit.t - exact.t) <= std::fabs(rival.t - exact.t)) {
        ++agreement.imprecise;
        continue;
      }
    }
    // One of them has a nearer triangle that the other did not take: is that a matter of rounding?
    const Hit& nearer = hit.t < rival.t ? hit : rival;
    const ExactCrossing exact = cross(mesh, nearer.primitive, rays[i]);
    if (std::fabs(exact.least_weight) <= exact.edge_error || exact.cosine < 1e-4L) {
      ++agreement.grazing;
      continue;
    }
    ++agreement.unexplained;
    if (agreement.examples.size() < 5)
      agreement.examples.push_back(fmt::format("ray {}: t {} triangle {} against t {} triangle {}; exact t {}, least weight {}, cosine {}",
                                               i, hit.t, hit.primitive, rival.t, rival.primitive, static_cast<double>(exact.t),
                                               static_cast<double>(exact.least_weight), static_cast<double>(exact.cosine)));
  }
  return agreement;
}

}  // namespace grove::bench
