#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "grove/registry/registry.h"

namespace grove::test {

/// Families whose keys meet in so many ways that the whole matrix runs over a few specs, which together have each value of each key but the numbers;
/// the others run over all geometries in one test each (CombinedKeys).
[[nodiscard]] inline std::vector<std::string> combined_specs(std::string_view family) {
  if (family == "kdtree")
    return {"kdtree", "kdtree:split=binned,walk=ropes,mailbox=false", "kdtree:split=object-median,clip=false,walk=ropes,leaf-size=4"};
  if (family == "octree")
    return {"octree", "octree:split=octree-r,walk=neighbour,planes=joint,candidates=3,mailbox=false",
            "octree:store=inner,walk=neighbour,build=merge,leaf-size=1"};
  return {};
}

/// Whether a family builds one of the others, over which the matrix runs anyway: a test each is enough for its keys.
[[nodiscard]] inline bool builds_others(std::string_view family) {
  return family == "auto";
}

/// The representative specs of all families.
[[nodiscard]] inline std::vector<std::string> representatives() {
  std::vector<std::string> specs;
  for (const std::string_view spec : representative_specs())
    if (combined_specs(spec.substr(0, spec.find(':'))).empty()) specs.emplace_back(spec);
  for (const StructureFamily& family : structure_families())
    for (const std::string& spec : combined_specs(family.name)) specs.push_back(canonical_spec(spec));
  return specs;
}

/// A spec as a part of a test's name.
[[nodiscard]] inline std::string as_test_name(std::string text) {
  for (char& c : text) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return text;
}

}  // namespace grove::test
