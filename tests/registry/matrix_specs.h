#pragma once

#include <cctype>
#include <string>
#include <vector>

#include "grove/registry/registry.h"

namespace grove::test {

/// The representative specs of all families.
[[nodiscard]] inline std::vector<std::string> representatives() {
  return {representative_specs().begin(), representative_specs().end()};
}

/// A spec as a part of a test's name.
[[nodiscard]] inline std::string as_test_name(std::string text) {
  for (char& c : text) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return text;
}

}  // namespace grove::test
