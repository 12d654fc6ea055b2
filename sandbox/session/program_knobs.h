// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/module.h"
#include "engine/render/views/renderer_knobs.h"
#include "sandbox/options.h"

namespace gloam {

// The knobs of the program itself, which no module owns.
inline constexpr OnOffKnob kDefaultLight{
    .name = "scene.default_light",
    .meaning = "a soft sky and a low sun for a scene that has neither a light nor a sky; read when a scene is loaded",
    .choices = {{"on", true}, {"off", false}},
    .default_value = true,
    .is_look = true};
/// Value of kHeatRange: the range follows what is shown (heat_fit.h).
inline constexpr float kFitHeatRange = 0.0f;
inline constexpr ChoiceKnob<float> kHeatRange{
    .name = "views.range",
    .meaning =
        "factor on the value at the end of the colour scales of views; fit: the smallest one that fits what is "
        "shown, for counts the smallest end of 5, 10, 15, 20, 25, 30, 40, 50, 60, 80, 100 … that does; play sets fit",
    .choices = {{"1", 1.0f},
                {"fit", kFitHeatRange},
                {"1/16", 1.0f / 16.0f},
                {"1/8", 1.0f / 8.0f},
                {"1/4", 1.0f / 4.0f},
                {"1/2", 1.0f / 2.0f},
                {"2", 2.0f},
                {"4", 4.0f},
                {"8", 8.0f},
                {"16", 16.0f}},
    .default_value = 1.0f,
    .is_look = true};

/// Adds the knobs above to those of a renderer.
void add_program_knobs(KnobRegistry& knobs);

/// Value of kHeatRange, for ViewSettings::heat_range; 1 if it is kFitHeatRange, or if the registry lacks the knob.
[[nodiscard]] float heat_range(const KnobRegistry& knobs);
/// Value of kViewScale; 1 if the registry lacks the knob.
[[nodiscard]] double view_scale(const KnobRegistry& knobs);
[[nodiscard]] bool fits_heat_range(const KnobRegistry& knobs);
/// The factors among the choices of kHeatRange, ascending; none if the registry lacks the knob.
[[nodiscard]] std::vector<float> heat_ranges(const KnobRegistry& knobs);

/// The knobs of these modules, of the renderer and of the program, with their defaults.
[[nodiscard]] KnobRegistry all_knobs(const ModuleList& modules);

/// Sets knobs from --config, then from --set. Before, `play` and `render` turn antialiasing on, `play` fits the
/// colour scales of views, and `cost` and `bench` turn the reuse of shadows off. Usage error for an unknown knob or
/// value.
[[nodiscard]] Status set_knobs(KnobRegistry& knobs, const Options& options);

}  // namespace gloam
