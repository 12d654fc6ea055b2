// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/renderer.h"
#include "modules/reflections/bake/picture.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {

/// The orthographic view of a proxy: it looks against the proxy's normal, has the exact size of the quad, and sees from
/// 10 % of the quad's longer side in front of it (at least 0.25 unit_m, at most 1) to 25 % behind it (1, 4). unit_m:
/// scene_unit(). side: pixels of both sides, so pixels are not square where the quad is not. Of a sheared proxy it
/// shows the rectangle along half_u.
[[nodiscard]] ViewSettings proxy_view(const PlacedProxy& proxy, std::uint32_t side, double unit_m = 1.0);

/// What a proxy shows, with `side` × `side` texels, alpha 0 where no opaque surface was met. u runs along half_u, v
/// against half_v.
struct ProxyCapture {
  CapturedPicture all;
  CapturedPicture unlit;   ///< the part of it that no lamp causes; equally covered
  float surface_m = 0.0f;  ///< CapturedParts::surface_m
};

/// Draws the static scene as proxy_view() sees it. light_scale: of the captures.
[[nodiscard]] Result<ProxyCapture> capture_proxy(Renderer& renderer, World& world, const PlacedProxy& proxy,
                                                 std::uint32_t side, float light_scale);

}  // namespace gloam
