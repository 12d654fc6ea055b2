// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/tiles.h"
#include "shaders/reflections/reflections_shared.h"

namespace gloam {

/// Rows of the proxies that a view may reflect, in the order of ProxyTiles::proxies; with `all`, rows of all proxies of
/// the set, in its order. A proxy without a captured image has dim 0, which the shader never shows.
[[nodiscard]] std::vector<shaders::ProxyRow> proxy_rows(const World& world, const RenderView& view, const ProxySet& set,
                                                        const ProxyTiles& tiles, const ReflectionCaptures& captures,
                                                        bool all);

/// Factor of a proxy's captured colour: its own lights now, as a share of what they were. 1 if it has none.
[[nodiscard]] float proxy_dim(const World& world, const ReflectionCaptures& captures, std::uint32_t layer);

/// The lights that differ from their state at capture, with what is missing of them. Lights that no longer exist are
/// left out: their place is not known.
[[nodiscard]] std::vector<shaders::ChangedLight> changed_lights(const World& world, const RenderView& view,
                                                                const ReflectionCaptures& captures);

}  // namespace gloam
