#include "layer_options.h"

#include <CLI/Option.hpp>

#include "grove/base/error.h"

namespace grove::app {

void add_layers(CLI::App& verb, LayerOptions& options) {
  verb.add_option("--layers", options.text,
                  "What an .exr holds beside its colours: all, none, or some of albedo,normal,depth,motion,variance,samples,id,noisy "
                  "(default: albedo,normal)")
      ->type_name("LIST");
}

void parse_layers(LayerOptions& options) {
  if (!options.text) return;
  try {
    options.layers = layers_from_text(*options.text);
  } catch (const UsageError& error) {
    throw UsageError("--layers: " + std::string(error.what()));
  }
}

void ask_for_layers(const LayerOptions& options, GatheringSettings& gathering) {
  const LayerSet& layers = options.layers;
  gathering.first_hits = gathering.first_hits || layers.has(Layer::depth) || layers.has(Layer::motion) || layers.has(Layer::id);
}

}  // namespace grove::app
