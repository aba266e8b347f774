#pragma once

#include <cstdint>

namespace grove {

/// What a kernel does beside finding hits. It is compiled for each, so that those that do nothing else pay for nothing else.
enum class Beside : std::uint8_t {
  nothing,
  counting,   ///< nodes, leaves and tests
  filtering,  ///< asks which of the hits that it would take count
};

}  // namespace grove
