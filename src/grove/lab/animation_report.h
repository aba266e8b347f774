#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "grove/lab/animation.h"

namespace grove {

/// A line a policy for people: what its updates did and took, what rays cost, and the time of a frame.
[[nodiscard]] std::string animation_table(const Animation& animation);

/// scene, structure, rays, ray_count, primitives, machine, and a row for each frame and policy.
[[nodiscard]] nlohmann::ordered_json animation_json(const Animation& animation);

/// A heading and one line a row.
[[nodiscard]] std::string animation_csv(const Animation& animation);

}  // namespace grove
