#pragma once

// Which octants of a cell a primitive reaches into: by its box, then by itself.

#include <array>
#include <cstdint>
#include <span>

#include "grove/build/primitive_reference.h"

namespace grove {

/// A cell and the planes that cut it.
struct OctantCut {
  Box4 cell;
  Float4 planes;
  /// Bit a: the cell is cut across axis a. Where it is not, the plane is the cell's upper end and nothing lies above it.
  std::uint32_t axes = 0;

  [[nodiscard]] Box4 octant(std::uint32_t number) const {
    Box4 box = cell;
    for (int axis = 0; axis < 3; ++axis) ((number >> axis & 1U) != 0 ? box.lower : box.upper)[axis] = planes[axis];
    return box;
  }

  /// Bit o: the box reaches into octant o. One that only touches a plane from one side is on that side; one that lies in a plane is below it.
  [[nodiscard]] std::uint32_t octants_of(const PrimitiveReference& reference) const {
    const auto above = static_cast<std::uint32_t>(first_three_lanes(reference.upper > planes)) & axes;
    const auto below = static_cast<std::uint32_t>(first_three_lanes(reference.lower < planes)) | (~above & 7U);
    return kOctants[below | above << 3U];
  }

 private:
  static constexpr std::array<std::uint8_t, 64> kOctants = [] {
    std::array<std::uint8_t, 64> octants{};
    for (unsigned sides = 0; sides < 64; ++sides) {
      for (unsigned octant = 0; octant < 8; ++octant) {
        bool is_met = true;
        for (unsigned axis = 0; axis < 3; ++axis)
          is_met = is_met && ((octant >> axis & 1U) != 0 ? sides >> (axis + 3) : sides >> axis) % 2 == 1;
        if (is_met) octants[sides] = static_cast<std::uint8_t>(octants[sides] | 1U << octant);
      }
    }
    return octants;
  }();
};

/// Narrows what boxes say to what the primitives themselves overlap; hides the geometry from builders, at one virtual call a batch.
class OverlapTest {
 public:
  virtual ~OverlapTest() = default;
  /// octants[i] belongs to primitive ids[i]. Of several octants those stay that it overlaps.
  virtual void narrow(const OctantCut& cut, std::span<const std::uint32_t> ids, std::uint8_t* octants) const = 0;
};

template <Geometry G>
class GeometryOverlapTest final : public OverlapTest {
 public:
  explicit GeometryOverlapTest(const G& geometry) : geometry_(geometry) {}
  void narrow(const OctantCut& cut, std::span<const std::uint32_t> ids, std::uint8_t* octants) const override {
    Box boxes[8];
    for (std::uint32_t octant = 0; octant < 8; ++octant) boxes[octant] = cut.octant(octant).box();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::uint32_t met = octants[i];
      if ((met & (met - 1)) == 0) continue;
      std::uint32_t overlapped = 0;
      for (std::uint32_t octant = 0; octant < 8; ++octant)
        if ((met >> octant & 1U) != 0 && geometry_.overlaps(ids[i], boxes[octant])) overlapped |= 1U << octant;
      // Never none, whatever a geometry may answer.
      if (overlapped != 0) octants[i] = static_cast<std::uint8_t>(overlapped);
    }
  }

 private:
  const G& geometry_;
};

}  // namespace grove
