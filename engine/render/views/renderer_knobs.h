// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// The renderer does not read it. A host draws its views with this share of their width and height, and enlarges the
/// pictures: by accumulation (ViewTarget::width) or by a filter of its own. A FrameBudget moves it like other knobs.
inline constexpr ChoiceKnob<double> kViewScale{
    .name = "views.scale",
    .meaning =
        "share of the picture's width and height that is drawn. Cost and render enlarge the result by a Lanczos filter "
        "on "
        "the CPU, whose time is not counted; play has --scale; other hosts read it and enlarge by themselves",
    .choices = {{"1", 1.0}, {"0.85", 0.85}, {"0.7", 0.7}, {"0.5", 0.5}, {"0.35", 0.35}},
    .default_value = 1.0,
    .exact = 1.0,
    .scales_frame = true};

/// Adds the knobs of the renderer, which no module owns. Renderer::knobs() has them.
void add_renderer_knobs(KnobRegistry& knobs);

}  // namespace gloam
