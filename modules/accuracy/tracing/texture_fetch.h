// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Index of the texel that a coordinate outside of 0 … size − 1 shows. size: > 0.
[[nodiscard]] inline std::size_t wrapped_texel(std::int64_t at, std::int64_t size, WrapMode mode) {
  if (mode == WrapMode::clamp_to_edge) return static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, size - 1));
  const std::int64_t period = mode == WrapMode::mirrored_repeat ? 2 * size : size;
  const std::int64_t phase = ((at % period) + period) % period;
  return static_cast<std::size_t>(phase < size ? phase : period - 1 - phase);
}

/// Coordinate in texels; 0 if it is NaN or its magnitude is 1e15 or more.
[[nodiscard]] inline double texel_coordinate(float uv, std::uint32_t size) {
  const double at = static_cast<double>(uv) * size;
  return std::abs(at) < 1e15 ? at : 0.0;
}

/// Samples textures as a frame does, but mip 0 only.
class TextureFetch {
 public:
  TextureFetch();

  /// Linear colour and alpha at `uv` (after the texture transform). White if the slot or its image is absent.
  [[nodiscard]] vec4 sample(const SceneAssets& assets, const TextureSlot& slot, vec2 uv) const;

 private:
  std::array<float, 256> linear_of_srgb_;  ///< the linear value of each sRGB-encoded byte
};

}  // namespace gloam
