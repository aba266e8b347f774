#pragma once

namespace grove {

/// The largest float that is not above v.
[[nodiscard]] float round_down(double v);

/// The smallest float that is not below v.
[[nodiscard]] float round_up(double v);

}  // namespace grove
