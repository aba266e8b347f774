#include "grove/scene/gltf/gpu_instances.h"

#include <algorithm>

#include "grove/scene/animation/affine.h"
#include "grove/scene/gltf/accessors.h"

namespace grove {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

}  // namespace

bool has_gpu_instances(const JsonCursor& node) {
  return node.extension(kExtension).exists();
}

std::vector<Mat4> read_gpu_instances(GltfDocument& document, const JsonCursor& node) {
  const GltfAccessors accessors(document);
  const JsonCursor attributes = node.extension(kExtension)["attributes"];
  std::vector<Vec3> translations;
  std::vector<Vec4> rotations;
  std::vector<Vec3> scales;
  if (attributes["TRANSLATION"].exists()) translations = accessors.vec3s(attributes["TRANSLATION"]);
  if (attributes["ROTATION"].exists()) rotations = accessors.vec4s(attributes["ROTATION"]);
  if (attributes["SCALE"].exists()) scales = accessors.vec3s(attributes["SCALE"]);
  const std::size_t count = std::max({translations.size(), rotations.size(), scales.size()});
  for (const std::size_t size : {translations.size(), rotations.size(), scales.size()}) {
    if (size != 0 && size != count) attributes.fail("has accessors of different lengths");
  }
  // An instance is a transform with its inverse and a name.
  constexpr std::size_t kInstanceBytes = 256;
  document.charge(count * kInstanceBytes, attributes);

  std::vector<Mat4> transforms(count, Mat4(1.0F));
  for (std::size_t i = 0; i < count; ++i) {
    const Vec4 q = rotations.empty() ? Vec4(0.0F, 0.0F, 0.0F, 1.0F) : rotations[i];
    transforms[i] = Mat4(compose_transform(translations.empty() ? glm::dvec3(0.0) : glm::dvec3(translations[i]), glm::dvec4(q),
                                           scales.empty() ? glm::dvec3(1.0) : glm::dvec3(scales[i])));
  }
  return transforms;
}

}  // namespace grove
