// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "engine/render/packing/caster_bounds.h"
#include "modules/closeups/pairs/views.h"
#include "modules/closeups/umbra/light.h"

/// Frustum of a close-up pair's face: FF XVI §3.1, figure 9. Changed: it encloses exactly the penumbra of a wide
/// emitter (FF's umbra is that of a point). If the subject hides part of the emitter from a receiver, then the
/// direction from the emitter's centre to the receiver meets the subject's box grown by the emitter's radius.
namespace gloam {

/// The face of a close-up pair.
struct CloseupFrustum {
  ShadowFace face;         ///< the caller sets its light and its place in the map (square.origin)
  float tan_inner = 0.0f;  ///< see CloseupView
};

/// Axes of a face that looks along the unit vector `forward`. When `forward` turns, they rotate as little as possible,
/// also where `forward` passes straight down. The only discontinuity is at straight up.
struct CloseupAxes {
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
};
[[nodiscard]] CloseupAxes closeup_axes(const dvec3& forward);

/// `receivers`: box of everything that may receive a directional light's shadow, if known. `size`: side of the face in
/// texels, ≥ 64. Depth range of a local light: from the subject's nearest point along the axis (at least 5 cm) to the
/// light's range. Depth range of a directional light: from the subject's nearest point to the farthest point of subject
/// and receivers. The two border texels on each side stay empty, unless a spot's cone is the smaller bound: then the
/// rim is 1/8 of the half extent, as in standard maps. None if no face can hold the subject: the light is inside the
/// subject's box grown by the emitter's radius, the subject reaches beyond a tangent of 2 from the axis, or numbers are
/// not finite.
[[nodiscard]] std::optional<CloseupFrustum> closeup_frustum(const CloseupLight& light, const WorldBox& subject,
                                                            const WorldBox& receivers, std::uint32_t size);

/// Side of a pair's face in texels: a power of two, at least 64, enough for settings.texels_per_pixel over `tiles`. At
/// most the side of the close-up map, or half of it if pairs share the map.
[[nodiscard]] std::uint32_t closeup_size(const CloseupSettings& settings, const TileRange& tiles);

}  // namespace gloam
