#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "grove/render/layers/layer_set.h"
#include "grove/render/render.h"

namespace grove::app {

/// What an .exr holds beside its colours.
struct LayerOptions {
  std::optional<std::string> text;
  LayerSet layers = LayerSet::usual();  ///< after `parse_layers`
};

void add_layers(CLI::App& verb, LayerOptions& options);

/// Throws UsageError for a layer that there is not.
void parse_layers(LayerOptions& options);

/// Has a render gather what the layers need.
void ask_for_layers(const LayerOptions& options, GatheringSettings& gathering);

}  // namespace grove::app
