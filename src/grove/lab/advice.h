#pragma once

#include <string>
#include <vector>

#include "grove/lab/comparison.h"

namespace grove {

/// Which of the structures that were compared to take for one use, and why.
struct Advice {
  std::string use;        ///< "static offline", "static interactive", "moving vertices", "moving objects" or "memory-bound"
  std::string structure;  ///< canonical spec
  std::string why;        ///< one sentence, with the figures that it rests on
};

/// One for each use, in this order; none where nothing was timed. A ray is as dear as recorded rays are where they were traced, else as the geometric mean over the
/// kinds of rays. Structures that failed on any kind are left out, and so is `auto`, which is one of the others.
[[nodiscard]] std::vector<Advice> advise(const Comparison& comparison);

}  // namespace grove
