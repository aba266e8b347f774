#pragma once

#include <cstdio>
#include <exception>

namespace grove::bench {

/// The main function of a benchmark: `run`, or one line that says what went wrong, and 1.
inline int run_program(const char* name, int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
}

}  // namespace grove::bench
