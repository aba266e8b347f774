#pragma once

#include <string>

namespace grove {

/// What a measurement was made on.
struct Machine {
  std::string cpu;       ///< the processor's name, or "unknown"
  unsigned cores = 0;    ///< hardware threads that this process may use
  unsigned threads = 0;  ///< threads of the caller's oneTBB arena
  std::string compiler;
  std::string commit;  ///< of Grove when it was built; empty when that is not known
  std::string os;
};

[[nodiscard]] Machine describe_machine();

}  // namespace grove
