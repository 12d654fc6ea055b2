// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "engine/ecs/world.h"
#include "engine/render/knobs/measure.h"

namespace gloam {

/// For Module::idle_knob.
[[nodiscard]] std::string idle_shadow_knob(const World& world, std::string_view knob, const FrameCounters& counters);

/// Whether a mesh that casts shadows, or a volume of casters, comes so near to a wide lamp that shadows.near may take
/// effect. Never false if one does; the boxes of meshes at rest count.
[[nodiscard]] bool has_near_blocker(const World& world);

}  // namespace gloam
