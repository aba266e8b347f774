#include "grove/scene/gltf/skin_sets.h"

#include <cmath>
#include <string>

namespace grove {
namespace {

// Weights in bytes may sum to four 255ths more or less than 1 by rounding.
constexpr float kTolerance = 0.02F;

struct Trouble {
  bool has_unknown_joint = false;
  bool has_broken_weight = false;
  bool has_other_sum = false;
};

// Takes what cannot be used out of a vertex's weights and makes the rest sum to 1.
void mend_vertex(std::size_t v, std::size_t joint_count, std::vector<SkinSet>& sets, Trouble& trouble) {
  float sum = 0.0F;
  for (SkinSet& set : sets) {
    for (int k = 0; k < 4; ++k) {
      float& weight = set.weights[v][k];
      const bool is_usable = weight >= 0.0F && std::isfinite(weight);
      const bool is_known = set.joints[v][k] < joint_count;
      trouble.has_broken_weight = trouble.has_broken_weight || !is_usable;
      trouble.has_unknown_joint = trouble.has_unknown_joint || (!is_known && is_usable && weight > 0.0F);
      if (!is_usable || !is_known) weight = 0.0F;
      if (!is_known) set.joints[v][k] = 0;
      sum += weight;
    }
  }
  if (!(std::abs(sum - 1.0F) <= kTolerance)) trouble.has_other_sum = true;
  if (!(sum > 0.0F) || !std::isfinite(sum)) {
    for (SkinSet& set : sets) set.weights[v] = Vec4(0.0F);
    sets.front().weights[v].x = 1.0F;
    sets.front().joints[v].x = 0;
    return;
  }
  for (SkinSet& set : sets) set.weights[v] *= 1.0F / sum;
}

}  // namespace

std::vector<SkinSet> read_skin_sets(GltfDocument& document, const VertexSource& source, const JsonCursor& primitive,
                                    std::size_t joint_count, Scene& scene) {
  std::vector<SkinSet> sets;
  if (joint_count == 0) return sets;
  const JsonCursor attributes = primitive["attributes"];
  std::string number = "0";
  for (unsigned set = 0; attributes["JOINTS_" + number].exists(); number = std::to_string(++set)) {
    SkinSet& read = sets.emplace_back();
    read.joints = source.integer_vec4s("JOINTS_" + number);
    read.weights = source.vec4s("WEIGHTS_" + number);
    if (read.weights.size() != read.joints.size()) attributes["WEIGHTS_" + number].fail("is missing beside JOINTS_" + number);
  }
  if (sets.empty()) {
    // All of it is held by the first joint.
    document.charge(source.vertex_count() * (sizeof(Vec4) + sizeof(glm::u32vec4)), primitive);
    sets.push_back(
        {std::vector<glm::u32vec4>(source.vertex_count(), glm::u32vec4(0)), std::vector<Vec4>(source.vertex_count(), Vec4(0.0F))});
  }
  Trouble trouble;
  for (std::size_t v = 0; v < source.vertex_count(); ++v) mend_vertex(v, joint_count, sets, trouble);
  const auto warn = [&](bool happened, const char* kind, const std::string& what) {
    if (happened && document.is_first(kind)) scene.warn(what + ", such as in " + primitive.path());
  };
  warn(trouble.has_unknown_joint, "unknown joint", "joint numbers that a skin does not have are left out");
  warn(trouble.has_broken_weight, "broken weight", "joint weights that are negative or not finite are left out");
  warn(trouble.has_other_sum && !trouble.has_unknown_joint && !trouble.has_broken_weight && attributes["JOINTS_0"].exists(), "weight sum",
       "joint weights that do not sum to 1 are scaled until they do");
  return sets;
}

}  // namespace grove
