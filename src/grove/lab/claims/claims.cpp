#include <algorithm>
#include <array>

#include "grove/lab/claims/claim.h"

namespace grove {
namespace {

/// By section of the review.
std::vector<Claim> list_claims() {
  std::vector<Claim> claims;
  for (const std::span<const Claim> some :
       {octree_form_claims(), octree_claims(), kd_tree_claims(), hierarchy_claims(), heuristic_claims(), cost_model_claims(),
        construction_claims(), movement_claims(), octree_r_claims(), auto_claims()})
    claims.insert(claims.end(), some.begin(), some.end());
  std::ranges::stable_sort(claims, {}, [](const Claim& claim) { return claim.source.substr(0, claim.source.find(',')); });
  return claims;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  constexpr std::array<std::string_view, 3> kNames{"holds", "fails", "mixed"};
  return kNames.at(static_cast<std::size_t>(verdict));
}

std::span<const Claim> review_claims() {
  static const std::vector<Claim> claims = list_claims();
  return claims;
}

}  // namespace grove
