#include "grove/registry/auto.h"

#include "grove/registry/choose_structure.h"

namespace grove {

StructureFamily describe_auto() {
  return {
      "auto",
      "looks at some of the primitives and builds one of the others, by what building and tracing are known to take",
      {{"use",
        {"still", "moving", "memory"},
        0,
        0,
        0,
        "built once and traced; follows primitives that move; or as little memory as is sensible"},
       {"rays", {}, 0, 1'000'000, 0, "millions of rays until it is built anew or follows; 0 for 100, and for 2 where primitives move"}}};
}

std::unique_ptr<Accelerator> build_auto(const Spec& spec, const GeometryPointer& geometry) {
  return build(geometry, choose_structure(geometry, use_of(spec.canonical())).structure);
}

}  // namespace grove
