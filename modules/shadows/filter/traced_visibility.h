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

/// How much of each light reaches the surface under each pixel of one frame, as rays have found it. A resource of the
/// world: while it is there, as large as a view and `shades`, shading takes these visibilities instead of its shadow
/// maps'. Whoever sets it removes it before the view, a light or anything that casts or receives shadows moves.
struct TracedVisibility {
  std::uint32_t width = 0;  ///< pixels
  std::uint32_t height = 0;
  bool shades = true;          ///< false: only views that compare look at it, shading stays with its shadow maps
  std::vector<Entity> lights;  ///< by layer; lights that reach no pixel of the frame or cast no shadow have none: they
                               ///< are lit everywhere
  /// One byte a pixel, rows from the top, layer after layer: 0 nothing of the light is seen … 255 all of it. 255 where
  /// `judged` is not set.
  std::vector<std::uint8_t> visibility;
  /// One bit a byte of `visibility`, bit i % 8 of byte i / 8: whether the light reaches the surface, by range and cone,
  /// so that rays were traced. Sky is never judged.
  std::vector<std::uint8_t> judged;
  std::uint32_t samples = 0;  ///< rays a light and pixel; one for lights without width
  double noise = 0.0;         ///< mean change of a judged visibility from half to all of the samples
  std::uint64_t version = 0;  ///< another one for other content

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
