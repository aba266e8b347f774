#pragma once

#include <span>

#include "grove/build/primitive_reference.h"

namespace grove {

/// The mark of a reference with nothing of its primitive in its box, in the lane that is free.
inline void mark_as_outside(PrimitiveReference& reference) {
  reference.upper[3] = 1.0F;
}
[[nodiscard]] inline bool is_outside(const PrimitiveReference& reference) {
  return reference.upper[3] != 0.0F;
}

/// Bounds pieces of primitives; hides the geometry from builders, at one virtual call a batch.
class ReferenceClipper {
 public:
  virtual ~ReferenceClipper() = default;
  /// Shrinks the box of each reference to what of its primitive is inside. Where nothing is, leaves the box and marks the reference.
  virtual void clip(std::span<PrimitiveReference> references) const = 0;
};

template <Geometry G>
class GeometryClipper final : public ReferenceClipper {
 public:
  explicit GeometryClipper(const G& geometry) : geometry_(geometry) {}
  void clip(std::span<PrimitiveReference> references) const override {
    for (PrimitiveReference& reference : references) {
      const Box inside = geometry_.clip(reference.primitive(), reference.box().box());
      if (inside.is_empty()) {
        mark_as_outside(reference);
      } else {
        reference = make_reference(inside, reference.primitive());
      }
    }
  }

 private:
  const G& geometry_;
};

/// Leaves boxes as they are.
class NoClipper final : public ReferenceClipper {
 public:
  void clip(std::span<PrimitiveReference> /*references*/) const override {}
};

}  // namespace grove
