#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace grove {

/// What an EXR picture may hold beside its colours.
enum class Layer : std::uint8_t {
  albedo,    ///< how much light the first surface reflects, mean over the samples
  normal,    ///< shading normal of the first surface, world space, mean over the samples
  depth,     ///< distance of the first surface along the viewing axis
  motion,    ///< how far the first surface has moved in the picture since the frame before
  variance,  ///< of the pixel's mean luminance, estimated from its samples
  samples,   ///< how many samples the pixel's colour is the mean of
  id,        ///< primitive, geometry and instance that the pixel's first sample hit
  noisy      ///< the colours before a denoiser; only where one was at work
};

/// The names of the layers, in the order of the enumeration.
[[nodiscard]] std::span<const std::string_view> layer_names();

/// Some of the layers.
class LayerSet {
 public:
  /// None.
  constexpr LayerSet() = default;
  /// Albedo and normal, which denoisers look for.
  [[nodiscard]] static constexpr LayerSet usual() { return LayerSet().with(Layer::albedo).with(Layer::normal); }
  [[nodiscard]] static constexpr LayerSet all() { return LayerSet((1U << 8) - 1); }

  [[nodiscard]] constexpr bool has(Layer layer) const { return (bits_ & bit(layer)) != 0; }
  [[nodiscard]] constexpr LayerSet with(Layer layer) const { return LayerSet(bits_ | bit(layer)); }
  [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }

  friend bool operator==(const LayerSet&, const LayerSet&) = default;

 private:
  explicit constexpr LayerSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Layer layer) { return 1U << static_cast<std::uint32_t>(layer); }

  std::uint32_t bits_ = 0;
};

/// The layers that "all", "none" or a list of names with commas between them stands for. Throws UsageError that lists the names.
[[nodiscard]] LayerSet layers_from_text(std::string_view text);

}  // namespace grove
