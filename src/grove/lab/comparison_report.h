#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "grove/lab/comparison.h"

namespace grove {

/// {"median": …, "min": …, "max": …}
[[nodiscard]] nlohmann::ordered_json spread_json(const Spread& spread);

/// cpu, cores, threads, compiler, commit and os.
[[nodiscard]] nlohmann::ordered_json machine_json(const Machine& machine);

/// Two tables for people: what each structure is, and how it traces each kind of rays, one block a kind. Failed rows carry their reason. The notes
/// follow.
[[nodiscard]] std::string comparison_table(const Comparison& comparison);

/// What follows from the tables: from how many rays on which structure is quickest, what matching memory gave, and advice for each use.
[[nodiscard]] std::string comparison_advice(const Comparison& comparison);

/// The shape "grove-compare" of docs/command-line.md. A failed row has an `error`, and null for each figure that it lacks.
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// A heading and one line a row, comma-separated as RFC 4180 has it, except that lines end with a newline alone.
[[nodiscard]] std::string comparison_csv(const Comparison& comparison);

}  // namespace grove
