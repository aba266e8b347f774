#include "grove/render/denoise/illumination.h"

#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"

namespace grove {

std::vector<float> Illumination::luminances() const {
  std::vector<float> values(red.size());
  parallel_for(values.size(), 4096, [&](std::size_t i) { values[i] = luminance(colour(i)); });
  return values;
}

}  // namespace grove
