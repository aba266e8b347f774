#include "grove/render/sampling/distribution_2d.h"

#include <algorithm>

namespace grove {
namespace {

// Fills `cumulative` (one longer than `weights`) with running sums scaled to end at 1, and returns the sum.
double accumulate(std::span<const double> weights, std::span<float> cumulative) {
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  double running = 0.0;
  cumulative[0] = 0.0F;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    running += sum > 0.0 ? weights[i] / sum : 1.0 / static_cast<double>(weights.size());
    cumulative[i + 1] = static_cast<float>(running);
  }
  cumulative[weights.size()] = 1.0F;
  return sum;
}

// The cell that u falls into, and where in it. Cells of no width are never chosen.
std::uint32_t find_cell(std::span<const float> cumulative, float u, float& within) {
  const auto above = std::upper_bound(cumulative.begin() + 1, cumulative.end() - 1, u);
  const auto cell = static_cast<std::uint32_t>(above - cumulative.begin() - 1);
  const float span = cumulative[cell + 1] - cumulative[cell];
  within = span > 0.0F ? std::clamp((u - cumulative[cell]) / span, 0.0F, 1.0F) : 0.5F;
  return cell;
}

std::uint32_t cell_of(float coordinate, std::uint32_t count) {
  if (!(coordinate > 0.0F)) return 0;
  return std::min(static_cast<std::uint32_t>(std::min(coordinate, 1.0F) * static_cast<float>(count)), count - 1);
}

}  // namespace

Distribution2D::Distribution2D(std::span<const float> weights, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), row_cumulative_(height + std::size_t{1}), column_cumulative_(height * (width + std::size_t{1})) {
  std::vector<double> rows(height);
  std::vector<double> row(width);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) row[x] = static_cast<double>(weights[std::size_t{y} * width + x]);
    rows[y] = accumulate(row, std::span(column_cumulative_).subspan(y * (width + std::size_t{1}), width + std::size_t{1}));
  }
  accumulate(rows, row_cumulative_);
}

Distribution2D::Draw Distribution2D::draw(const Vec2& u) const {
  Vec2 within;
  const std::uint32_t y = find_cell(row_cumulative_, u.y, within.y);
  const auto columns = std::span(column_cumulative_).subspan(y * (width_ + std::size_t{1}), width_ + std::size_t{1});
  const std::uint32_t x = find_cell(columns, u.x, within.x);
  return {
      {(static_cast<float>(x) + within.x) / static_cast<float>(width_), (static_cast<float>(y) + within.y) / static_cast<float>(height_)},
      cell_density(x, y)};
}

float Distribution2D::density(const Vec2& point) const {
  return cell_density(cell_of(point.x, width_), cell_of(point.y, height_));
}

float Distribution2D::cell_density(std::uint32_t x, std::uint32_t y) const {
  const float* columns = column_cumulative_.data() + y * (width_ + std::size_t{1});
  const float row_chance = row_cumulative_[y + 1] - row_cumulative_[y];
  const float column_chance = columns[x + 1] - columns[x];
  return row_chance * column_chance * static_cast<float>(width_) * static_cast<float>(height_);
}

}  // namespace grove
