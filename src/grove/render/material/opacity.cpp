#include "grove/render/material/opacity.h"

#include <algorithm>

#include "grove/render/texture/evaluate_texture.h"

namespace grove {

float opacity(const Scene& scene, const Material& material, const SurfaceCoordinates& place) {
  float result = 1.0F;
  if (material.kind == MaterialKind::interface && !material.is_emissive()) return 0.0F;
  if (material.kind == MaterialKind::mix) {
    const float amount = std::clamp(evaluate(scene, material.mix_amount, place.texture), 0.0F, 1.0F);
    result = opacity(scene, scene.materials[material.mix_material[0]], place) * (1.0F - amount) +
             opacity(scene, scene.materials[material.mix_material[1]], place) * amount;
  }
  if (material.alpha_mode == AlphaMode::opaque) return result;
  const float alpha = evaluate(scene, material.alpha, place.texture) * place.colour_alpha;
  if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff ? result : 0.0F;
  return result * std::clamp(alpha, 0.0F, 1.0F);
}

bool can_pass_light(const Scene& scene, const Material& material) {
  if (material.kind == MaterialKind::interface || material.alpha_mode != AlphaMode::opaque) return true;
  return material.kind == MaterialKind::mix && (can_pass_light(scene, scene.materials[material.mix_material[0]]) ||
                                                can_pass_light(scene, scene.materials[material.mix_material[1]]));
}

}  // namespace grove
