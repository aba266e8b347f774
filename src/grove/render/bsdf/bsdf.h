#pragma once

#include <variant>

#include "grove/render/bsdf/diffuse.h"
#include "grove/render/bsdf/gltf_layers.h"
#include "grove/render/bsdf/layered.h"

namespace grove {

/// Any scattering function, as a value: no allocation, no virtual call. See bsdf_types.h for what the functions mean.
class Bsdf {
 public:
  using Model = std::variant<DiffuseBsdf, DiffuseTransmissionBsdf, ConductorBsdf, DielectricBsdf, ThinDielectricBsdf, ThinTransmissionBsdf,
                             CoatedDiffuseBsdf, CoatedConductorBsdf, MetallicRoughnessBsdf, GltfLayersBsdf>;

  Bsdf() = default;
  // Implicit, since a model is a Bsdf.
  template <typename M>
  // NOLINTNEXTLINE(google-explicit-constructor)
  requires std::constructible_from<Model, M> Bsdf(const M& model) : model_(model) {}

  [[nodiscard]] BsdfValue evaluate(const Vec3& wo, const Vec3& wi) const {
    return std::visit([&](const auto& model) { return model.evaluate(wo, wi); }, model_);
  }
  [[nodiscard]] BsdfSample sample(const Vec3& wo, float u_lobe, const Vec2& u) const {
    return std::visit([&](const auto& model) { return model.sample(wo, u_lobe, u); }, model_);
  }
  [[nodiscard]] Vec3 albedo(const Vec3& wo) const {
    return std::visit([&](const auto& model) { return model.albedo(wo); }, model_);
  }
  [[nodiscard]] bool is_delta() const {
    return std::visit([](const auto& model) { return model.is_delta(); }, model_);
  }

 private:
  Model model_;
};

}  // namespace grove
