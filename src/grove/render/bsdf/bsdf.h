#pragma once

#include <concepts>
#include <variant>

#include "grove/render/bsdf/diffuse.h"
#include "grove/render/bsdf/layered.h"

namespace grove {

/// Any scattering function, as a value: no allocation, no virtual call. See bsdf_types.h for what the functions mean.
class Bsdf {
 public:
  using Model = std::variant<DiffuseBsdf, DiffuseTransmissionBsdf, ConductorBsdf, DielectricBsdf, ThinDielectricBsdf, ThinTransmissionBsdf,
                             CoatedDiffuseBsdf, CoatedConductorBsdf, MetallicRoughnessBsdf>;

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
  /// Nothing comes through: `evaluate` is zero for wi.z <= 0, and `sample` gives no such direction. Models that are not known for it count as
  /// letting light through.
  [[nodiscard]] bool reflects_only() const {
    return std::visit([]<typename M>(const M& /*model*/) { return kReflectsOnly<M>; }, model_);
  }

 private:
  template <typename M>
  static constexpr bool kReflectsOnly =
      std::same_as<M, DiffuseBsdf> || std::same_as<M, ConductorBsdf> || std::same_as<M, CoatedDiffuseBsdf> ||
      std::same_as<M, CoatedConductorBsdf> || std::same_as<M, MetallicRoughnessBsdf>;

  Model model_;
};

}  // namespace grove
