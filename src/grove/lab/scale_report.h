#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "grove/lab/scale_study.h"

namespace grove {

/// The shape "grove-scale" of docs/command-line.md.
[[nodiscard]] nlohmann::ordered_json scale_json(const ScaleStudy& study);

/// For people: a table of structures by size, a table of exponents, and what failed.
[[nodiscard]] std::string scale_text(const ScaleStudy& study);

}  // namespace grove
