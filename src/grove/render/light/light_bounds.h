#pragma once

#include "grove/math/box.h"

namespace grove {

/// What is known of a set of lights together: where they are, where they shine, and how strongly. After Conty Estevez and Kulla 2018, "Importance
/// Sampling of Many Lights with Adaptive Tree Splitting", section 4.1; but where they add up power, this adds up intensity, which is what
/// a distance squared is to divide, so that lights of different kinds can be weighed against each other. Power is intensity times
/// `orientation_measure`.
struct LightBounds {
  Box box;
  /// All emitters' axes (normals; spots' directions) lie within theta_o of it. Unit length.
  Vec3 axis{0.0F, 0.0F, 1.0F};
  float theta_o = 0.0F;  ///< radians, 0 to pi
  /// No emitter sends light farther than this off its own axis; radians, 0 to pi / 2.
  float theta_e = 0.0F;
  /// Sum over the lights of the luminance of the intensity in the direction in which it is greatest.
  float intensity = 0.0F;
  /// Emitters may shine against their axes as well.
  bool is_two_sided = false;

  /// Holds no lights.
  [[nodiscard]] bool is_empty() const { return box.is_empty(); }

  /// Takes in other lights. The cones of axes are joined by the paper's algorithm 1; those of emitters with two sides are turned to the same side
  /// before.
  void add(const LightBounds& other);

  /// The solid angle that the lights shine into, weighed by the cosine beyond theta_o (the paper's M_Omega), steradians.
  [[nodiscard]] float orientation_measure() const;
};

}  // namespace grove
