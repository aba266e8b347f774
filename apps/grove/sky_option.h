#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "grove/scene/scene.h"

namespace grove::app {

/// Light from all around in place of what the scene says: an option of `grove render`.
struct SkyOption {
  std::string text;
  std::optional<Vec3> radiance;  ///< after `parse_sky`, where there is one
};

void add_sky(CLI::App& verb, SkyOption& option);

/// Understands the option. Throws UsageError for what is not three finite numbers from 0 on.
void parse_sky(SkyOption& option);

/// Gives the scene this sky, where one is asked for.
void set_sky(const SkyOption& option, Scene& scene);

}  // namespace grove::app
