// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/knobs/knob_table.h"

namespace gloam {

inline constexpr OnOffKnob kAmbientOcclusion{
    .name = "lighting.occlusion",
    .meaning =
        "light that opaque surfaces get from their surroundings is reduced where surfaces in the picture within 1 m "
        "hide the surroundings",
    .choices = {{"on", true}, {"off", false}},
    .default_value = false};

}  // namespace gloam
