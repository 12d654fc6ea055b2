// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/relighting/capture_factors.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// Rows of the proxies that a view may reflect, in the order of ProxyTiles::proxies; with `all`, rows of all proxies of
/// the set, in its order. A proxy without a captured image has opacity 0, which the shader never shows. factors: by
/// layer of the captures; empty: captured light is shown as captured, except that of fires. cells:
/// CaptureFactors::cells(), to which the factors of fires are appended.
[[nodiscard]] std::vector<shaders::ProxyRow> proxy_rows(const World& world, const RenderView& view, const ProxySet& set,
                                                        const ProxyTiles& tiles, const ReflectionCaptures& captures,
                                                        std::span<const CaptureFactor> factors, bool all,
                                                        std::vector<vec4>& cells);

/// Factor of the captured colour of a proxy that shows a light of its own (own_light): its lights now, as a share of
/// what they were. 1 if it has none.
[[nodiscard]] float proxy_dim(const World& world, const ReflectionCaptures& captures, std::uint32_t layer);

}  // namespace gloam
