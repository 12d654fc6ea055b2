// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"

namespace gloam {

/// What the lights module leaves for a view.
struct LightsOutputs {
  gpu::Binding::BufferRange lights;  ///< a LightBlock (shaders/lights/lights_shared.h), uniform
  ImageRef texels;                   ///< rgba32f, 3 × GLOAM_MAX_LOCAL_LIGHTS: local lights as light_texels.comp writes them
  ImageRef tile_masks;               ///< r32ui, 33 layers, one texel an 8×8 tile; none when lights.culling = brute
  std::uint32_t local_count = 0;
  std::uint32_t directional_count = 0;
};

/// Bytes of a LightBlock without lights, for shading a scene that has none.
[[nodiscard]] std::span<const std::byte> empty_light_block();

/// Indices of the lights in one tile's mask. `layers`: the 33 words of one texel; words whose group bit is 0 are not looked at.
[[nodiscard]] std::vector<std::uint32_t> decode_tile_mask(std::span<const std::uint32_t> layers);

}  // namespace gloam
