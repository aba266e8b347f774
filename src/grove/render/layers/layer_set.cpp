#include "grove/render/layers/layer_set.h"

#include <algorithm>
#include <array>

#include "grove/base/error.h"

namespace grove {
namespace {

constexpr std::array<std::string_view, 8> kNames = {"albedo", "normal", "depth", "motion", "variance", "samples", "id", "noisy"};

}  // namespace

std::span<const std::string_view> layer_names() {
  return kNames;
}

LayerSet layers_from_text(std::string_view text) {
  if (text == "all") return LayerSet::all();
  if (text == "none") return {};
  LayerSet layers;
  for (bool is_last = false; !is_last;) {
    const std::size_t comma = text.find(',');
    is_last = comma == std::string_view::npos;
    const std::string_view name = text.substr(0, comma);
    const auto* const found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) {
      std::string list;
      for (const std::string_view known : kNames) list.append(list.empty() ? "" : ", ").append(known);
      throw UsageError("unknown layer '" + std::string(name) + "'; choose all, none, or some of " + list);
    }
    layers = layers.with(static_cast<Layer>(found - kNames.begin()));
    if (!is_last) text.remove_prefix(comma + 1);
  }
  return layers;
}

}  // namespace grove
