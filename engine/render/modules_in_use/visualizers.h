// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/module.h"

namespace gloam {

/// The visualizers of the renderer itself, then those of the modules in list order.
[[nodiscard]] std::vector<VisualizerInfo> all_visualizers(const ModuleList& modules);

/// The code of one of the renderer's own visualizers in debug_view.frag; 0 for all other names.
[[nodiscard]] std::uint32_t engine_visualizer_code(std::string_view name);

/// Usage error that lists the valid names, unless there is a visualizer of this name, with or without an argument.
[[nodiscard]] Status check_visualizer_name(const ModuleList& modules, std::string_view name);

/// Usage error unless the visualizer can be shown: its name, its argument and the knob that it needs. world: prepared.
[[nodiscard]] Status check_visualizer(const ModuleList& modules, const KnobRegistry& knobs, const World& world,
                                      std::string_view name);

}  // namespace gloam
