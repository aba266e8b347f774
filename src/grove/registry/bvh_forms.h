#pragma once

// The forms in which the family `bvh` is traced. A source each, so that each compiles its instances once.

#include <memory>

#include "grove/registry/registry.h"
#include "grove/registry/spec.h"

namespace grove {

/// Two children a node, axis-aligned boxes.
[[nodiscard]] std::unique_ptr<Accelerator> build_binary_bvh(const Spec& spec, const GeometryPointer& geometry);

/// Up to four, or eight, children a node, axis-aligned boxes.
[[nodiscard]] std::unique_ptr<Accelerator> build_bvh4(const Spec& spec, const GeometryPointer& geometry);
[[nodiscard]] std::unique_ptr<Accelerator> build_bvh8(const Spec& spec, const GeometryPointer& geometry);

/// Any number of children a node; oriented boxes, or spheres.
[[nodiscard]] std::unique_ptr<Accelerator> build_bvh_obb(const Spec& spec, const GeometryPointer& geometry);
[[nodiscard]] std::unique_ptr<Accelerator> build_bvh_sphere(const Spec& spec, const GeometryPointer& geometry);

}  // namespace grove
