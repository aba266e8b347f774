#include "grove/render/sample_batch.h"

#include "grove/render/film_ray.h"

namespace grove {

SampleBatch::SampleBatch(const PreparedScene& world, const CameraRays& camera, const PathSettings& settings, std::uint64_t seed, Film& film)
    : camera_(&camera), seed_(seed), film_(&film), paths_(world, settings) {
  pixels_.reserve(kSize);
  samplers_.reserve(kSize);
  rays_.reserve(kSize);
  samples_.reserve(kSize);
}

void SampleBatch::add(std::uint32_t x, std::uint32_t y, std::uint32_t number) {
  const Sampler& sampler = samplers_.emplace_back(seed_, x, y, number);
  pixels_.push_back({x, y});
  rays_.push_back(film_ray(*camera_, x, y, sampler));
  if (pixels_.size() >= kSize) finish();
}

void SampleBatch::finish() {
  samples_.resize(pixels_.size());
  paths_.trace(rays_, samplers_, samples_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) film_->add(pixels_[i].x, pixels_[i].y, samples_[i]);
  pixels_.clear();
  samplers_.clear();
  rays_.clear();
}

}  // namespace grove
