#include "grove/scene/formats/ply_polygons.h"

#include <string>

#include "grove/base/error.h"

namespace grove {

void PlyPolygons::read(const PlyElement& element, PlyNumbers& numbers, bool vertices_known, std::size_t reserve) {
  const bool strips = element.name == "tristrips";
  if (!strips) mesh_.triangles.reserve(reserve);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (!property.is_list || (property.name != "vertex_indices" && property.name != "vertex_index")) {
        numbers.skip(property);
        continue;
      }
      if (is_ply_float(property.type)) numbers.fail("the vertex indices of the faces must be an integer type");
      const std::uint64_t length = numbers.next_list_length(property);
      if (strips) {
        read_strip(property.type, length, numbers);
      } else {
        read_polygon(property.type, length, numbers, vertices_known);
      }
    }
  }
}

void PlyPolygons::finish(const PlyNumbers& numbers) {
  std::size_t first = 0;
  for (const std::size_t length : waiting_lengths_) {
    add(std::span(waiting_).subspan(first, length), numbers);
    first += length;
  }
}

std::uint32_t PlyPolygons::checked(std::int64_t index, const PlyNumbers& numbers) const {
  if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
    numbers.fail("a face names vertex " + std::to_string(index) + ", but there are " + std::to_string(vertex_count_));
  }
  return static_cast<std::uint32_t>(index);
}

void PlyPolygons::read_polygon(PlyType type, std::uint64_t length, PlyNumbers& numbers, bool vertices_known) {
  corners_.clear();
  for (std::uint64_t i = 0; i < length; ++i) corners_.push_back(checked(numbers.next_integer(type), numbers));
  if (length == 3) {
    mesh_.triangles.emplace_back(corners_[0], corners_[1], corners_[2]);
  } else if (vertices_known) {
    add(corners_, numbers);
  } else {
    waiting_.insert(waiting_.end(), corners_.begin(), corners_.end());
    waiting_lengths_.push_back(corners_.size());
  }
}

// Each entry makes a triangle with the two before it, wound the other way round every other time; -1 begins anew.
void PlyPolygons::read_strip(PlyType type, std::uint64_t length, PlyNumbers& numbers) {
  std::uint64_t run = 0;
  std::uint32_t before[2] = {0, 0};
  for (std::uint64_t i = 0; i < length; ++i) {
    const std::int64_t entry = numbers.next_integer(type);
    if (entry == -1) {
      run = 0;
      continue;
    }
    const std::uint32_t index = checked(entry, numbers);
    if (run >= 2) {
      const bool odd = run % 2 == 1;
      mesh_.triangles.emplace_back(before[odd ? 1 : 0], before[odd ? 0 : 1], index);
    }
    before[0] = before[1];
    before[1] = index;
    ++run;
  }
}

void PlyPolygons::add(std::span<const std::uint32_t> polygon, const PlyNumbers& numbers) {
  points_.clear();
  for (const std::uint32_t corner : polygon) points_.push_back(mesh_.vertices[corner]);
  try {
    for (const auto& [a, b, c] : triangulator_.triangulate(points_)) {
      mesh_.triangles.emplace_back(polygon[a], polygon[b], polygon[c]);
    }
  } catch (const InputError& error) {
    numbers.fail(error.what());
  }
}

}  // namespace grove
