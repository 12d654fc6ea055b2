// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/module.h"
#include "sandbox/options.h"

namespace gloam {

/// Adds the knobs of the program itself, which no module owns: scene.default_light, which is read when a scene is
/// loaded, and views.range.
void add_program_knobs(KnobRegistry& knobs);

/// Value of views.range, for ViewSettings::heat_range; 1 if it is "fit" (heat_fit.h).
[[nodiscard]] float heat_range(const KnobRegistry& knobs);
[[nodiscard]] bool fits_heat_range(const KnobRegistry& knobs);
/// The factors among the choices of views.range, ascending.
[[nodiscard]] std::vector<float> heat_ranges(const KnobRegistry& knobs);

/// The knobs of these modules and of the program, with their defaults.
[[nodiscard]] KnobRegistry all_knobs(const ModuleList& modules);

/// Sets knobs from --config, then from --set. Before, `play` and `render` turn antialiasing on, and `play` fits the
/// colour scales of views. Usage error for an unknown knob or value.
[[nodiscard]] Status set_knobs(KnobRegistry& knobs, const Options& options);

}  // namespace gloam
