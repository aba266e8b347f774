#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "grove/geometry/hit.h"
#include "grove/geometry/ray.h"

namespace grove {

/// A NumPy file of rays: float32, shape (N, 8), C order; origin x y z, t_min, direction x y z, t_max.
class RayFile {
 public:
  /// Opens the file and checks type, shape and length. Throws InputError naming what is wrong and what is wanted.
  explicit RayFile(const std::filesystem::path& path);

  [[nodiscard]] std::uint64_t ray_count() const { return ray_count_; }

  /// All rays: 32 bytes each, and nothing besides. Throws InputError when reading fails.
  [[nodiscard]] std::vector<Ray> read();

 private:
  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t data_offset_ = 0;
  std::uint64_t ray_count_ = 0;
};

/// Writes rays as RayFile reads them. Throws OutputError.
void write_rays(const std::filesystem::path& path, std::span<const Ray> rays);

/// Writes a NumPy structured array of one record a hit: t, u, v as float32; primitive, geometry, instance as uint32. Throws OutputError.
void write_hits(const std::filesystem::path& path, std::span<const Hit> hits);

}  // namespace grove
