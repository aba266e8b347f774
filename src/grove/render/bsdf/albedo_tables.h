#pragma once

#include <array>
#include <cstddef>

namespace grove {

/// A function of the cosine to the normal and of GGX width, tabulated and interpolated. Nodes are denser where it changes quickly: at
/// grazing angles and small widths.
class AlbedoTable {
 public:
  static constexpr std::size_t kNodes = 24;

  /// The coordinates of a node: cosine and alpha are the squares of i / (kNodes - 1); a cosine of 0 stands for 1e-4.
  [[nodiscard]] static float node_cosine(std::size_t i);
  [[nodiscard]] static float node_alpha(std::size_t i);

  /// A place between nodes: the first of the four round it, and how far it is on to the next.
  struct Place {
    std::size_t node;
    float cosine_fraction;
    float alpha_fraction;
  };
  /// Arguments are clamped to [0, 1].
  [[nodiscard]] static Place locate(float cosine, float alpha);
  [[nodiscard]] float at(const Place& place) const;

  [[nodiscard]] float& at(std::size_t alpha_node, std::size_t cosine_node) { return values_[alpha_node * kNodes + cosine_node]; }
  [[nodiscard]] float operator()(float cosine, float alpha) const { return at(locate(cosine, alpha)); }

 private:
  std::array<float, kNodes * kNodes> values_{};
};

/// A function of GGX width alone, on the same nodes.
class AverageTable {
 public:
  [[nodiscard]] float& at(std::size_t alpha_node) { return values_[alpha_node]; }
  [[nodiscard]] float operator()(float alpha) const;

 private:
  std::array<float, AlbedoTable::kNodes> values_{};
};

/// What a GGX mirror returns of light from everywhere, for Schlick reflectance F0 + (1 - F0) w: F0 * scale + bias
/// (Karis 2013, "Real Shading in Unreal Engine 4"), single scattering.
struct GgxAlbedo {
  struct Single {
    float scale;
    float bias;
  };
  /// Both at one place, which is looked for once.
  [[nodiscard]] Single single(float cosine, float alpha) const;
  /// The cosine-weighted mean of the reflectance from `f0` to `f90` after compensation.
  [[nodiscard]] float mean(float f0, float f90, float alpha) const;

  AlbedoTable scale;
  AlbedoTable bias;
  /// Cosine-weighted means from which that of the reflectance after compensation follows, for Schlick reflectance F0 + (F90 - F0) w:
  /// F90 mean_bias + F0 (mean_scale + F90 mean_bias_gain) + F0^2 mean_scale_gain, where _gain is with the factor (1 - E) / E.
  AverageTable mean_scale;
  AverageTable mean_bias;
  AverageTable mean_scale_gain;
  AverageTable mean_bias_gain;
};

/// Made on first use; may be called by many threads at once.
[[nodiscard]] const GgxAlbedo& ggx_albedo();

/// What a rough boundary between two dielectrics reflects and lets through in single scattering, from its outer side (index 0, where the
/// light is in the thinner medium) and its inner side (index 1). Divided by their sum they lose nothing.
struct DielectricAlbedo {
  /// `index` is that of the inner side over the outer, above 0. Takes some tens of milliseconds.
  explicit DielectricAlbedo(float index);

  float ior;
  std::array<AlbedoTable, 2> reflected;
  std::array<AlbedoTable, 2> total;
  /// Cosine-weighted mean of reflected / total.
  std::array<AverageTable, 2> mean_reflectance;
};

}  // namespace grove
