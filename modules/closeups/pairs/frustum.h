// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "engine/render/scene/caster_bounds.h"
#include "modules/closeups/pairs/light.h"
#include "modules/closeups/pairs/views.h"

/// The view from which a pair's map is drawn. FF XVI §3.1, figure 9. Changed: it encloses the penumbra of a wide
/// emitter (FF's umbra is a point's), exactly: receivers that some of the emitter cannot see for a subject lie in the
/// directions in which the subject's box, grown by the emitter's radius, lies.
namespace gloam {

/// What a pair's map shows.
struct CloseupFrustum {
  ShadowFace face;         ///< without a place; its light is left to the caller
  float tan_inner = 0.0f;  ///< see CloseupView
};

/// Axes of a map that looks along the unit vector `forward`: as it turns they turn by as little as can be, also
/// straight down; only straight up they are not continuous.
struct CloseupAxes {
  vec3 right = vec3(1.0f, 0.0f, 0.0f);
  vec3 up = vec3(0.0f, 1.0f, 0.0f);
  vec3 forward = vec3(0.0f, 0.0f, -1.0f);
};
[[nodiscard]] CloseupAxes closeup_axes(const dvec3& forward);

/// `receivers`: box of what a directional light's shadow may fall on, if known. size: texels of the map's side,
/// from 64. A local light's map reaches from the subject's nearest point along its axis, or 5 cm, to the light's range;
/// a directional one's from the subject's nearest point to the farthest one of subject and receivers. The map's border
/// holds nothing of the subject, two texels wide, unless the cone of a spot light is the smaller bound: then its rim is
/// an eighth of its half extent as standard maps' are. Nothing where no map can hold the subject: the light is in its
/// box grown by the emitter, it reaches beyond tangents of 2 from the map's axis, or numbers are not finite.
[[nodiscard]] std::optional<CloseupFrustum> closeup_frustum(const CloseupLight& light, const WorldBox& subject,
                                                            const WorldBox& receivers, std::uint32_t size);

/// Texels of the side of a pair's map: a power of two, at least 64, that gives the tiles it falls on as many as
/// settings ask for where there is room; pairs that share the map have half its side.
[[nodiscard]] std::uint32_t closeup_size(const CloseupSettings& settings, const TileRange& tiles);

}  // namespace gloam
