#include "grove/registry/bvh_forms.h"
#include "grove/registry/bvh_volume.h"

namespace grove {

std::unique_ptr<Accelerator> build_bvh_sphere(const Spec& spec, const GeometryPointer& geometry) {
  return build_volume_bvh<BoundingSphere>(spec, geometry);
}

}  // namespace grove
