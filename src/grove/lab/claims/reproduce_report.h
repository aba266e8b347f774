#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "grove/lab/claims/reproduce.h"

namespace grove {

/// The shape is in docs/command-line.md. Claims without a verdict are under `failed`.
[[nodiscard]] nlohmann::ordered_json reproduction_json(const Reproduction& reproduction);
/// Back from the same shape, to go on from. `file` names it in messages. Throws InputError where it is another one.
[[nodiscard]] Reproduction reproduction_from_json(const nlohmann::ordered_json& json, const std::string& file);

/// For the terminal: verdict, statement and what was measured, with a newline at the end.
[[nodiscard]] std::string claim_text(const CheckedClaim& claim);

/// "26 claims: 12 hold, …"
[[nodiscard]] std::string tally_text(const Reproduction& reproduction);

/// A document: what was found by section of the review, then each experiment with its figures. It stands between two lines that mark it as generated.
[[nodiscard]] std::string reproduction_markdown(const Reproduction& reproduction);

/// `document` with what stands between the marks in it replaced by `generated`, which has them too; what is written by hand around them stays.
/// Only `generated` where the document has no marks.
[[nodiscard]] std::string replace_generated(std::string_view document, const std::string& generated);

}  // namespace grove
