#include "grove/render/sampling/sampler.h"

#include "grove/base/random.h"

namespace grove {
namespace {

std::uint32_t reverse_bits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555U) | ((v & 0x55555555U) << 1);
  v = ((v >> 2) & 0x33333333U) | ((v & 0x33333333U) << 2);
  v = ((v >> 4) & 0x0f0f0f0fU) | ((v & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(v);
}

// A permutation in which each bit depends on lower bits only: Owen's scrambling of a bit-reversed number (Laine and Karras 2011).
std::uint32_t permute_upward(std::uint32_t v, std::uint32_t seed) {
  v += seed;
  v ^= v * 0x6c50b47cU;
  v ^= v * 0xb82f1e52U;
  v ^= v * 0xc7afe638U;
  v ^= v * 0x8d22f6e6U;
  return v;
}

// The generator matrix of Sobol's second dimension, bit-reversed. It is Pascal's triangle modulo 2, the fifth Kronecker power of
// [1 1; 0 1], so that it takes five steps instead of a loop over 32 bits.
std::uint32_t multiply_by_pascal(std::uint32_t v) {
  v ^= (v & 0xaaaaaaaaU) >> 1;
  v ^= (v & 0xccccccccU) >> 2;
  v ^= (v & 0xf0f0f0f0U) >> 4;
  v ^= (v & 0xff00ff00U) >> 8;
  v ^= (v & 0xffff0000U) >> 16;
  return v;
}

float to_unit_interval(std::uint32_t v) {
  return static_cast<float>(v >> 8) * 0x1p-24F;
}

struct SetSeeds {
  std::uint32_t shuffle;
  std::uint32_t first;
  std::uint32_t second;
};

SetSeeds set_seeds(std::uint64_t pixel_hash, std::uint32_t dimension) {
  const std::uint64_t a = mix_bits(pixel_hash + 0x9e3779b97f4a7c15ULL * (dimension + std::uint64_t{1}));
  const std::uint64_t b = mix_bits(a + 0x9e3779b97f4a7c15ULL);
  return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), static_cast<std::uint32_t>(b)};
}

}  // namespace

Sampler::Sampler(std::uint64_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t sample)
    : pixel_hash_(mix_bits(mix_bits(seed + 0x9e3779b97f4a7c15ULL) ^ (std::uint64_t{y} << 32 | x))),
      reversed_sample_(reverse_bits(sample)) {}

Vec2 Sampler::sample_2d(std::uint32_t dimension) const {
  const SetSeeds seeds = set_seeds(pixel_hash_, dimension);
  const std::uint32_t index = reverse_bits(permute_upward(reversed_sample_, seeds.shuffle));
  // Sobol's first dimension is the reversed index; scrambling reverses it again, so both reversals fall away.
  return {to_unit_interval(reverse_bits(permute_upward(index, seeds.first))),
          to_unit_interval(reverse_bits(permute_upward(multiply_by_pascal(index), seeds.second)))};
}

float Sampler::sample_1d(std::uint32_t dimension) const {
  const SetSeeds seeds = set_seeds(pixel_hash_, dimension);
  const std::uint32_t index = reverse_bits(permute_upward(reversed_sample_, seeds.shuffle));
  return to_unit_interval(reverse_bits(permute_upward(index, seeds.first)));
}

}  // namespace grove
