// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"

namespace gloam {

/// Traced visibility of each light at the surface under each pixel of one frame. A resource of the world: while it
/// exists, has the view's size and `shades` is set, shading uses it instead of shadow maps. The code that adds it must
/// remove it before the camera, a light, a caster or a receiver moves.
struct TracedVisibility {
  std::uint32_t width = 0;  ///< pixels
  std::uint32_t height = 0;
  bool shades = true;  ///< false: only visualizers that compare read it; shading uses shadow maps
  /// By layer. A light without a layer (it reaches no pixel or casts no shadow) counts as lit.
  std::vector<Entity> lights;
  /// One byte per pixel, rows from the top, layer after layer: 0 unlit … 255 fully lit. 255 where `judged` is not set.
  std::vector<std::uint8_t> visibility;
  /// One bit per byte of `visibility`, bit i % 8 of byte i / 8: whether the light reaches the surface by range and
  /// cone, so that rays were traced. Never set for sky.
  std::vector<std::uint8_t> judged;
  std::uint32_t samples = 0;  ///< rays per light and pixel; lights without width get one
  double noise = 0.0;         ///< mean absolute difference of judged visibilities between half of the samples and all
  std::uint64_t version = 0;  ///< hash of the content

  [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
  [[nodiscard]] std::optional<std::uint32_t> layer_of(Entity light) const {
    const auto at = std::find(lights.begin(), lights.end(), light);
    if (at == lights.end()) return std::nullopt;
    return static_cast<std::uint32_t>(at - lights.begin());
  }
  [[nodiscard]] std::span<const std::uint8_t> layer(std::uint32_t index) const {
    return std::span(visibility).subspan(index * pixels(), pixels());
  }
  /// at: index into `visibility`.
  [[nodiscard]] bool is_judged(std::size_t at) const { return (judged[at / 8] >> (at % 8) & 1u) != 0; }
};

}  // namespace gloam
