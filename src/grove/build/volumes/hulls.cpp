#include "grove/build/volumes/hulls.h"

#include <cmath>
#include <limits>
#include <vector>

#include "grove/math/rounding.h"

namespace grove {
namespace {

// Ranges of more hulls are cut into chunks of so many.
constexpr std::size_t kChunkSize = 32768;

struct Interval {
  double low[3] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                   std::numeric_limits<double>::infinity()};
  double high[3] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};

  void grow(int axis, double from, double to) {
    low[axis] = from < low[axis] ? from : low[axis];
    high[axis] = to > high[axis] ? to : high[axis];
  }
};

}  // namespace

void HullRange::fit_planes(OrientedBox& box) const {
  double length[3];
  for (int axis = 0; axis < 3; ++axis) length[axis] = std::hypot(box.axes[0][axis], box.axes[1][axis], box.axes[2][axis]);
  const auto measure = [&](std::size_t first, std::size_t last) {
    Interval interval;
    visit_points(first, last, [&](const glm::dvec3& point, double radius) {
      for (int axis = 0; axis < 3; ++axis) {
        const double p = box.along(axis, point);
        interval.grow(axis, p - radius * length[axis], p + radius * length[axis]);
      }
    });
    return interval;
  };
  std::vector<Interval> chunks((count_ + kChunkSize - 1) / kChunkSize);
  parallel_chunks(count_, kChunkSize,
                  [&](std::size_t chunk, std::size_t first, std::size_t last) { chunks[chunk] = measure(first_ + first, first_ + last); });
  Interval all;
  for (const Interval& chunk : chunks)
    for (int axis = 0; axis < 3; ++axis) all.grow(axis, chunk.low[axis], chunk.high[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = round_down(all.low[axis]);
    box.upper[axis] = round_up(all.high[axis]);
  }
}

HullRange::Farthest HullRange::farthest_from(const Vec3& centre) const {
  const glm::dvec3 middle(centre);
  const auto measure = [&](std::size_t first, std::size_t last) {
    Farthest farthest{middle, -1.0};
    if (list_.radii.empty()) {
      // Squared, with one root at the end.
      visit_points(first, last, [&](const glm::dvec3& point, double /*radius*/) {
        const glm::dvec3 offset = point - middle;
        const double squared = glm::dot(offset, offset);
        if (squared > farthest.distance) farthest = {point, squared};
      });
      farthest.distance = std::sqrt(farthest.distance);
    } else {
      visit_points(first, last, [&](const glm::dvec3& point, double radius) {
        const double distance = glm::length(point - middle);
        if (distance + radius <= farthest.distance) return;
        farthest = {distance > 0.0 ? point + (point - middle) * (radius / distance) : point + glm::dvec3(radius, 0.0, 0.0),
                    distance + radius};
      });
    }
    return farthest;
  };
  std::vector<Farthest> chunks((count_ + kChunkSize - 1) / kChunkSize);
  parallel_chunks(count_, kChunkSize,
                  [&](std::size_t chunk, std::size_t first, std::size_t last) { chunks[chunk] = measure(first_ + first, first_ + last); });
  Farthest all{middle, -1.0};
  for (const Farthest& chunk : chunks)
    if (chunk.distance > all.distance) all = chunk;
  return all;
}

}  // namespace grove
