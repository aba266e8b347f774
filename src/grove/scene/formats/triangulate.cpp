#include "grove/scene/formats/triangulate.h"

#include <cmath>
#include <string>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::uint32_t kGone = 0xffffffffU;

// Twice the signed area of a triangle.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

std::span<const std::array<std::uint32_t, 3>> Triangulator::triangulate(std::span<const Vec3> corners) {
  triangles_.clear();
  if (corners.size() < 3) return triangles_;
  const auto count = static_cast<std::uint32_t>(corners.size());
  if (count == 3 || !project(corners) || is_convex()) {
    fan(count);
  } else {
    if (corners.size() > kMaxConcaveCorners) {
      throw InputError("a concave polygon has " + std::to_string(corners.size()) + " corners; at most " +
                       std::to_string(kMaxConcaveCorners) + " are read: triangulate it before");
    }
    clip_ears();
  }
  return triangles_;
}

void Triangulator::fan(std::uint32_t count) {
  for (std::uint32_t i = 2; i < count; ++i) triangles_.push_back({0, i - 1, i});
}

// Drops the axis along which Newell's normal is longest. False when the polygon has no area or is not finite.
bool Triangulator::project(std::span<const Vec3> corners) {
  const glm::dvec3 origin(corners[0]);
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::dvec3(corners[i]) - origin;
    const glm::dvec3 b = glm::dvec3(corners[i + 1 < corners.size() ? i + 1 : 0]) - origin;
    normal += glm::cross(a, b);
  }
  const glm::dvec3 size = glm::abs(normal);
  const double largest = std::fmax(size.x, std::fmax(size.y, size.z));
  if (!(largest > 0.0) || !std::isfinite(size.x + size.y + size.z)) return false;
  const int dropped = largest == size.x ? 0 : largest == size.y ? 1 : 2;
  int u = (dropped + 1) % 3;
  int v = (dropped + 2) % 3;
  if (normal[dropped] < 0.0) std::swap(u, v);
  points_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 p = glm::dvec3(corners[i]) - origin;
    points_[i] = {p[u], p[v]};
  }
  return true;
}

// Convex: never a turn to the right, and once around rather than twice as a pentagram does (then x would turn back four times).
bool Triangulator::is_convex() const {
  const std::size_t count = points_.size();
  int turns_in_x = 0;
  double last_dx = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2& a = points_[i];
    const glm::dvec2& b = points_[(i + 1) % count];
    const glm::dvec2& c = points_[(i + 2) % count];
    if (area(a, b, c) < 0.0) return false;
    const double dx = b.x - a.x;
    if (dx == 0.0) continue;
    if (dx * last_dx < 0.0) ++turns_in_x;
    last_dx = dx;
  }
  return turns_in_x <= 2;
}

void Triangulator::clip_ears() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  next_.resize(count);
  previous_.resize(count);
  reflex_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    next_[i] = i + 1 < count ? i + 1 : 0;
    previous_[i] = i > 0 ? i - 1 : count - 1;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (corner_area(i) <= 0.0) reflex_.push_back(i);
  }

  // Losing an ear changes what its two neighbours are and nothing else, so each corner is tried once and again when a neighbour goes:
  // O(corners * reflex corners) in all.
  candidates_.clear();
  for (std::uint32_t i = 0; i < count; ++i) candidates_.push_back(i);
  std::uint32_t left = count;
  std::uint32_t corner = 0;
  for (std::size_t i = 0; i < candidates_.size() && left > 3; ++i) {
    corner = candidates_[i];
    if (next_[corner] == kGone || !is_ear(corner)) continue;
    const std::uint32_t before = previous_[corner];
    const std::uint32_t after = next_[corner];
    clip(corner);
    candidates_.push_back(before);
    candidates_.push_back(after);
    corner = after;
    --left;
  }
  while (next_[corner] == kGone) ++corner;
  // Three corners are left, or more if the polygon crosses itself: then any triangles will do.
  for (; left >= 3; --left) {
    const std::uint32_t after = next_[corner];
    triangles_.push_back({corner, after, next_[after]});
    next_[corner] = next_[after];
  }
}

double Triangulator::corner_area(std::uint32_t corner) const {
  return area(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

bool Triangulator::is_ear(std::uint32_t corner) const {
  const glm::dvec2& a = points_[previous_[corner]];
  const glm::dvec2& b = points_[corner];
  const glm::dvec2& c = points_[next_[corner]];
  if (!(area(a, b, c) > 0.0)) return false;
  for (const std::uint32_t other : reflex_) {
    const glm::dvec2& p = points_[other];
    // A bridge to a hole passes the same points twice; they do not block.
    if (p == a || p == b || p == c) continue;
    if (area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0) return false;
  }
  return true;
}

void Triangulator::clip(std::uint32_t corner) {
  const std::uint32_t before = previous_[corner];
  const std::uint32_t after = next_[corner];
  triangles_.push_back({before, corner, after});
  next_[before] = after;
  previous_[after] = before;
  next_[corner] = kGone;
  // A corner may stop being reflex by its neighbour's going, but never become so.
  std::erase_if(reflex_, [&](std::uint32_t r) { return r == corner || ((r == before || r == after) && corner_area(r) > 0.0); });
}

}  // namespace grove
