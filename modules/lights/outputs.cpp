// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/outputs.h"

#include <bit>

#include "engine/core/assert.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

std::span<const std::byte> empty_light_block() {
  static const shaders::LightBlock block{};
  return std::as_bytes(std::span(&block, 1));
}

std::vector<std::uint32_t> decode_tile_mask(std::span<const std::uint32_t> layers) {
  GLOAM_ASSERT(layers.size() == GLOAM_LIGHT_GROUPS + 1, "a tile mask has a word a group of lights and one for the groups");
  std::vector<std::uint32_t> lights;
  for (std::uint32_t groups = layers[GLOAM_LIGHT_GROUPS]; groups != 0; groups &= groups - 1) {
    const auto word = static_cast<std::uint32_t>(std::countr_zero(groups));
    for (std::uint32_t bits = layers[word]; bits != 0; bits &= bits - 1)
      lights.push_back(word * 32 + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
  return lights;
}

}  // namespace gloam
