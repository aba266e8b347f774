#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grove/scene/formats/ply_numbers.h"
#include "grove/scene/formats/triangulate.h"
#include "grove/scene/read_ply.h"

namespace grove {

/// Collects the polygons of the elements "face" and "tristrips", and turns them into triangles as soon as the vertices are known.
class PlyPolygons {
 public:
  PlyPolygons(PlyMesh& mesh, std::uint64_t vertex_count) : mesh_(mesh), vertex_count_(vertex_count) {}

  /// `vertices_known`: the mesh has its vertices already. `reserve` is how many triangles to make room for at once.
  void read(const PlyElement& element, PlyNumbers& numbers, bool vertices_known, std::size_t reserve);

  /// To be called at the end: triangulates polygons that came before the vertices that they name.
  void finish(const PlyNumbers& numbers);

 private:
  [[nodiscard]] std::uint32_t checked(std::int64_t index, const PlyNumbers& numbers) const;
  void read_polygon(PlyType type, std::uint64_t length, PlyNumbers& numbers, bool vertices_known);
  void read_strip(PlyType type, std::uint64_t length, PlyNumbers& numbers);
  void add(std::span<const std::uint32_t> polygon, const PlyNumbers& numbers);

  PlyMesh& mesh_;
  std::uint64_t vertex_count_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> waiting_;
  std::vector<std::size_t> waiting_lengths_;
  std::vector<Vec3> points_;
  Triangulator triangulator_;
};

}  // namespace grove
