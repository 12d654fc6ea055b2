// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/knobs/knob_table.h"

namespace gloam {

inline constexpr NumberKnob kLodPixels{
    .name = "scene.lod_pixels",
    .meaning =
        "greatest distance in the picture between the triangles that are drawn and all triangles of a mesh; for scenes "
        "of more than 131,072 triangles; 0: all triangles are drawn",
    .max = 4.0,
    .default_value = 0.0,
    .exact = 0.0,
    .unit = "pixels",
    .ledger_values = {0.0, 0.25, 0.5, 1.0, 2.0}};

[[nodiscard]] inline float lod_pixels(const KnobRegistry& knobs) {
  return static_cast<float>(knobs.try_value(kLodPixels).value_or(0.0));
}

}  // namespace gloam
