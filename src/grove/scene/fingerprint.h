#pragma once

#include <cstdint>

#include "grove/scene/scene.h"

namespace grove {

/// A number that two scenes share when pictures of them from the same camera are the same: a hash of geometry, instances, materials,
/// textures, images and light, down to the last bit. Names, cameras, the wanted film size and warnings do not count. Runs over all of the scene
/// in parallel in the caller's oneTBB arena, at the speed of memory on a few cores.
[[nodiscard]] std::uint64_t fingerprint(const Scene& scene);

}  // namespace grove
