#include "grove/render/denoise/brightness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grove/base/parallel.h"
#include "grove/render/bsdf/bsdf_types.h"

namespace grove {
namespace {

constexpr std::uint32_t kCell = 8;
// Relative standard error of a cell's brightness at which half of what it tells is taken.
constexpr float kTrustedError = 0.03F;
// Standard deviations by which all samples and the newest may be apart.
constexpr float kExplained = 2.0F;
// No cell is scaled by more either way: where nearly all light was taken away, what is left tells nothing.
constexpr float kMostScale = 4.0F;

// Sums over the pixels of a cell that show a surface.
struct Cell {
  Vec3 samples{0.0F};
  Vec3 newest{0.0F};
  Vec3 filtered{0.0F};
  float variance = 0.0F;  // of the luminance of `samples`
  float newest_variance = 0.0F;

  void add(const Cell& other) {
    samples += other.samples;
    newest += other.newest;
    filtered += other.filtered;
    variance += other.variance;
    newest_variance += other.newest_variance;
  }

  // Leaves all samples for the newest as far as the two do not fit together.
  void settle() {
    const float apart = luminance(newest) - luminance(samples);
    const float explained = kExplained * kExplained * (variance + newest_variance);
    const float part = apart * apart > explained ? std::min(1.0F, apart * apart / std::max(explained, 1e-30F) - 1.0F) : 0.0F;
    samples = glm::mix(samples, newest, part);
    variance = std::lerp(variance, newest_variance, part);
  }

  [[nodiscard]] Vec3 ratio() const {
    Vec3 result(1.0F);
    for (int c = 0; c < 3; ++c) {
      if (filtered[c] > 0.0F && samples[c] > 0.0F) result[c] = std::clamp(samples[c] / filtered[c], 1.0F / kMostScale, kMostScale);
    }
    return result;
  }

  // How far the cell's own ratio is to be trusted, 0 to 1: shrinkage by the variance of its estimate.
  [[nodiscard]] float trust() const {
    const float sum = luminance(filtered);
    if (!(sum > 0.0F)) return 0.0F;
    const float allowed = kTrustedError * kTrustedError * sum * sum;
    return allowed / (allowed + variance);
  }
};

struct RowSum {
  Vec3 all{0.0F};
  Vec3 doubtful{0.0F};
};

struct Level {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Cell> cells;
};

Level finest(const BrightnessEvidence& evidence, const Guides& guides, const Illumination& filtered) {
  Level level{(guides.width + kCell - 1) / kCell, (guides.height + kCell - 1) / kCell, {}};
  level.cells.resize(std::size_t{level.width} * level.height);
  parallel_for(level.height, 1, [&](std::size_t row) {
    for (std::size_t y = row * kCell; y < std::min<std::size_t>(guides.height, (row + 1) * kCell); ++y) {
      for (std::size_t x = 0; x < guides.width; ++x) {
        const std::size_t i = y * guides.width + x;
        if (!guides.is_surface(i)) continue;
        const Vec3 albedo = divisor(guides.albedo[i]);
        const float weight = luminance(albedo);
        Cell& cell = level.cells[row * level.width + x / kCell];
        cell.samples += evidence.samples.colour(i) * albedo;
        cell.filtered += filtered.colour(i) * albedo;
        cell.variance += weight * weight * evidence.samples.variance[i];
        if (!evidence.has_newest()) continue;
        cell.newest += evidence.newest.colour(i) * albedo;
        cell.newest_variance += weight * weight * evidence.newest.variance[i];
      }
    }
  });
  return level;
}

Level coarser(const Level& fine) {
  Level level{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  level.cells.resize(std::size_t{level.width} * level.height);
  for (std::uint32_t y = 0; y < fine.height; ++y)
    for (std::uint32_t x = 0; x < fine.width; ++x)
      level.cells[std::size_t{y / 2} * level.width + x / 2].add(fine.cells[std::size_t{y} * fine.width + x]);
  return level;
}

// A picture of ratios, one for each cell, as a bilinear function of place in units of cells.
Vec3 interpolated(const std::vector<Vec3>& values, std::uint32_t width, std::uint32_t height, Vec2 place) {
  place = glm::clamp(place - Vec2(0.5F), Vec2(0.0F), Vec2(static_cast<float>(width - 1), static_cast<float>(height - 1)));
  const auto x = std::min(static_cast<std::uint32_t>(place.x), width - 1);
  const auto y = std::min(static_cast<std::uint32_t>(place.y), height - 1);
  const std::uint32_t right = std::min(x + 1, width - 1);
  const std::uint32_t below = std::min(y + 1, height - 1);
  const Vec2 part = place - Vec2(static_cast<float>(x), static_cast<float>(y));
  const auto at = [&](std::uint32_t column, std::uint32_t row) { return values[std::size_t{row} * width + column]; };
  return glm::mix(glm::mix(at(x, y), at(right, y), part.x), glm::mix(at(x, below), at(right, below), part.x), part.y);
}

}  // namespace

void keep_brightness(const BrightnessEvidence& evidence, const Guides& guides, Illumination& filtered) {
  if (guides.width == 0 || guides.height == 0) return;
  std::vector<Level> levels{finest(evidence, guides, filtered)};
  while (levels.back().cells.size() > 1) levels.push_back(coarser(levels.back()));

  if (evidence.has_newest()) {
    for (Level& level : levels)
      for (Cell& cell : level.cells) cell.settle();
  }
  // From the whole picture down; each cell goes from what is around it towards its own ratio.
  std::vector<Vec3> ratios(1, levels.back().cells[0].ratio());
  for (std::size_t l = levels.size() - 1; l-- > 0;) {
    const Level& level = levels[l];
    const Level& around = levels[l + 1];
    std::vector<Vec3> own(level.cells.size());
    for (std::uint32_t y = 0; y < level.height; ++y) {
      for (std::uint32_t x = 0; x < level.width; ++x) {
        const std::size_t i = std::size_t{y} * level.width + x;
        const Vec2 place(0.5F * (static_cast<float>(x) + 0.5F), 0.5F * (static_cast<float>(y) + 0.5F));
        own[i] = glm::mix(interpolated(ratios, around.width, around.height, place), level.cells[i].ratio(), level.cells[i].trust());
      }
    }
    ratios = std::move(own);
  }
  const Level& level = levels.front();
  std::vector<Vec3> doubts(level.cells.size());
  std::ranges::transform(level.cells, doubts.begin(), [](const Cell& cell) { return Vec3(1.0F - cell.trust()); });
  const auto at_pixel = [&](const std::vector<Vec3>& values, std::size_t x, std::size_t y) {
    return interpolated(values, level.width, level.height, (Vec2(x, y) + Vec2(0.5F)) / static_cast<float>(kCell));
  };
  std::vector<RowSum> rows(guides.height);
  parallel_for(guides.height, 4, [&](std::size_t y) {
    for (std::size_t x = 0; x < guides.width; ++x) {
      const std::size_t i = y * guides.width + x;
      if (!guides.is_surface(i)) continue;
      const Vec3 scaled = filtered.colour(i) * at_pixel(ratios, x, y);
      filtered.set_colour(i, scaled);
      rows[y].all += scaled * divisor(guides.albedo[i]);
      rows[y].doubtful += scaled * divisor(guides.albedo[i]) * at_pixel(doubts, x, y);
    }
  });
  RowSum sum;
  for (const RowSum& row : rows) {
    sum.all += row.all;
    sum.doubtful += row.doubtful;
  }
  // What cells were drawn back by does not cancel out: what the whole picture lacks is given to where it is not sure.
  Vec3 rest(0.0F);
  for (int c = 0; c < 3; ++c) {
    const float lack = levels.back().cells[0].samples[c] - sum.all[c];
    if (sum.doubtful[c] > 0.0F) rest[c] = std::clamp(lack / sum.doubtful[c], 1.0F / kMostScale - 1.0F, kMostScale - 1.0F);
  }
  parallel_for(guides.height, 4, [&](std::size_t y) {
    for (std::size_t x = 0; x < guides.width; ++x) {
      const std::size_t i = y * guides.width + x;
      if (guides.is_surface(i)) filtered.set_colour(i, filtered.colour(i) * (Vec3(1.0F) + rest * at_pixel(doubts, x, y)));
    }
  });
}

}  // namespace grove
