// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/levels.h"

#include <algorithm>
#include <cmath>

#include "shaders/glare/glare_shared.h"

namespace gloam {
namespace {

constexpr double kNarrowest = 1.0 / 90.0;  // sigma of the first Gaussian, heights
// Along a side of the finest level. The image of its parts has twice as many texels and a few more, which every device
// can make.
constexpr double kMostCells = 2000.0;

/// Standard deviation of a level's blur in texels of the finest level.
double sigma_in_cells(std::size_t level) {
  return std::ldexp(glare_level_sigma(static_cast<std::uint32_t>(level)), static_cast<int>(level));
}

/// Levels up to the first whose blur is as wide as the widest Gaussian (within 1 %).
std::size_t level_count(double widest_cells) {
  std::size_t count = 1;
  while (sigma_in_cells(count - 1) < 0.99 * widest_cells) ++count;
  return count;
}

/// Gives a Gaussian's share to the two levels whose blurs are next to it, so that the variance is kept.
void add_gaussian(double sigma_cells, double share, std::vector<GlareLevel>& levels) {
  std::size_t above = 0;
  while (above < levels.size() && sigma_in_cells(above) < sigma_cells) ++above;
  if (above == 0 || above == levels.size()) {
    levels[above == 0 ? 0 : above - 1].weight += static_cast<float>(share);
    return;
  }
  const double low = std::pow(sigma_in_cells(above - 1), 2.0), high = std::pow(sigma_in_cells(above), 2.0);
  const double wider = (sigma_cells * sigma_cells - low) / (high - low);
  levels[above - 1].weight += static_cast<float>(share * (1.0 - wider));
  levels[above].weight += static_cast<float>(share * wider);
}

}  // namespace

const std::array<GlareGaussian, 6>& glare_spread() {
  static const std::array<GlareGaussian, 6> gaussians = [] {
    std::array<GlareGaussian, 6> spread;
    double sum = 0.0;
    for (std::size_t i = 0; i < spread.size(); ++i) {
      spread[i] = {std::ldexp(kNarrowest, static_cast<int>(i)), std::exp2(-0.5 * static_cast<double>(i))};
      sum += spread[i].share;
    }
    for (GlareGaussian& gaussian : spread) gaussian.share /= sum;
    return spread;
  }();
  return gaussians;
}

double glare_level_sigma(std::uint32_t level) {
  // Variances in texels of the level: bilinear weights have 1/6 at the finest level, twice (collect.comp, and where the
  // picture reads it); weights 1, 3, 3, 1 have 3/4 of a finer texel, down and up; weights 1, 2, 1 have 1/2
  // (spread.comp).
  const double way = 0.25 - (0.25 - 1.0 / 6.0) * std::ldexp(1.0, -2 * static_cast<int>(level));
  return std::sqrt(2.0 * way + 0.5);
}

GlareLevels glare_levels(uvec2 picture, std::uint32_t lines) {
  GlareLevels result;
  const double width = picture.x, height = picture.y;
  result.cell_px = std::max({height / std::min(lines, picture.y), width / kMostCells, height / kMostCells});
  const double columns = std::ceil(width / result.cell_px - 1e-9), rows = std::ceil(height / result.cell_px - 1e-9);
  result.cells = uvec2(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows));
  result.origin_px = 0.5 * (glm::dvec2(width, height) - result.cell_px * glm::dvec2(columns, rows));
  const double height_cells = height / result.cell_px;
  result.levels.resize(level_count(glare_spread().back().sigma * height_cells));
  uvec2 cells = result.cells;
  for (GlareLevel& level : result.levels) {
    level.size = cells + 2u * GLOAM_GLARE_MARGIN;
    cells = (cells + 1u) / 2u;
  }
  for (const GlareGaussian& gaussian : glare_spread())
    add_gaussian(gaussian.sigma * height_cells, gaussian.share, result.levels);
  return result;
}

}  // namespace gloam
