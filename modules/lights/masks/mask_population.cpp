// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/masks/mask_population.h"

#include <algorithm>
#include <bit>

namespace gloam {
namespace {

std::uint32_t lights_in(std::span<const std::uint32_t> mask, std::span<const std::uint32_t> chosen) {
  int count = 0;
  for (std::uint32_t groups = mask[0]; groups != 0; groups &= groups - 1) {
    const auto group = static_cast<std::size_t>(std::countr_zero(groups));
    const std::uint32_t counted = chosen.empty() ? ~0u : group < chosen.size() ? chosen[group] : 0u;
    count += std::popcount(mask[group + 1] & counted);
  }
  return static_cast<std::uint32_t>(count);
}

}  // namespace

std::uint64_t mask_population_of(const TileLightMasks& masks, uvec2 shadow_tiles,
                                 std::span<const std::uint32_t> counted, std::span<const std::uint32_t> chosen) {
  constexpr std::uint32_t kAcross = GLOAM_LIGHT_TILE / GLOAM_SHADOW_TILE;
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < masks.tiles.x * masks.tiles.y; ++i) {
    const uvec2 first = uvec2(i % masks.tiles.x, i / masks.tiles.x) * kAcross;
    const uvec2 end = glm::min(first + kAcross, shadow_tiles);
    std::uint32_t tiles = 0;
    for (std::uint32_t y = first.y; y < end.y; ++y) {
      for (std::uint32_t x = first.x; x < end.x; ++x) {
        const std::uint32_t tile = y * shadow_tiles.x + x;
        tiles += counted[tile / 32] >> (tile % 32) & 1u;
      }
    }
    if (tiles == 0) continue;
    const auto mask = std::span(masks.words).subspan(std::size_t{i} * GLOAM_MASK_WORDS, GLOAM_MASK_WORDS);
    sum += std::uint64_t{tiles} * lights_in(mask, chosen);
  }
  return sum;
}

std::uint64_t mask_population(const TileLightMasks& masks, uvec2 shadow_tiles, std::span<const std::uint32_t> chosen,
                              std::uint32_t step) {
  constexpr std::uint32_t kAcross = GLOAM_LIGHT_TILE / GLOAM_SHADOW_TILE;
  std::uint64_t sum = 0;
  for (std::uint32_t y = 0; y < masks.tiles.y; ++y) {
    for (std::uint32_t x = 0; x < masks.tiles.x; ++x) {
      const uvec2 first = uvec2(x, y) * kAcross;
      const uvec2 end = glm::min(first + kAcross, shadow_tiles);
      if (first.x >= end.x || first.y >= end.y) continue;
      const std::size_t at = (std::size_t{y} * masks.tiles.x + x) * GLOAM_MASK_WORDS;
      const std::uint32_t lights = lights_in(std::span(masks.words).subspan(at, GLOAM_MASK_WORDS), chosen);
      sum += std::uint64_t{(lights + step - 1) / step * step} * (end.x - first.x) * (end.y - first.y);
    }
  }
  return sum;
}

}  // namespace gloam
