#pragma once

#include <memory>

#include "grove/registry/registry.h"
#include "grove/registry/spec.h"

namespace grove {

/// A row of the registry: what a family is called, and how it is built. One function pair for each family, in a source of its own, so
/// that each compiles its instances once.
struct RegistryRow {
  StructureFamily (*describe)();
  std::unique_ptr<Accelerator> (*build)(const Spec& spec, const GeometryPointer& geometry);
};

[[nodiscard]] StructureFamily describe_brute();
[[nodiscard]] std::unique_ptr<Accelerator> build_brute(const Spec& spec, const GeometryPointer& geometry);

[[nodiscard]] StructureFamily describe_bvh();
[[nodiscard]] std::unique_ptr<Accelerator> build_bvh(const Spec& spec, const GeometryPointer& geometry);

[[nodiscard]] StructureFamily describe_fast();
[[nodiscard]] std::unique_ptr<Accelerator> build_fast(const Spec& spec, const GeometryPointer& geometry);

[[nodiscard]] StructureFamily describe_octree();
[[nodiscard]] std::unique_ptr<Accelerator> build_octree(const Spec& spec, const GeometryPointer& geometry);

[[nodiscard]] StructureFamily describe_kd_tree();
[[nodiscard]] std::unique_ptr<Accelerator> build_kd_tree(const Spec& spec, const GeometryPointer& geometry);

}  // namespace grove
