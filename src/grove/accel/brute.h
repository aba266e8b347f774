#pragma once

namespace grove {

/// The structure that has no structure.
struct Brute {};

}  // namespace grove
