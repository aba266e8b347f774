#pragma once

#include <memory>

#include "grove/registry/registry.h"
#include "grove/registry/spec.h"

namespace grove {

/// The family that chooses one of the others: see choose_structure.h.
[[nodiscard]] StructureFamily describe_auto();
[[nodiscard]] std::unique_ptr<Accelerator> build_auto(const Spec& spec, const GeometryPointer& geometry);

}  // namespace grove
