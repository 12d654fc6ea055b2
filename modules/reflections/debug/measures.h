// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/knobs/measure.h"
#include "engine/render/view.h"

namespace gloam {

/// Measures of the knobs that choose which proxies a pixel tests. Their pictures are compared with the one in which
/// every pixel tests all proxies of the world, without tiles and bounding spheres.
[[nodiscard]] std::vector<MeasureInfo> proxy_measures();

/// For Module::idle_knob.
[[nodiscard]] std::string idle_reflection_knob(const World& world, const RenderView& view, std::string_view knob);

}  // namespace gloam
