// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/module.h"

namespace gloam {

/// Declares the targets of a visualizer's pass: the view's picture, which it is drawn over (or in place of:
/// LoadOp::clear), and a new transient image `name` of the view's size, cleared to 0, for plain values that tests and
/// tools read. Returns the version of that image that later passes read.
ImageRef add_visualizer_targets(FrameBuilder& frame, DrawPass& pass, std::string name, gpu::Format values,
                                gpu::LoadOp picture = gpu::LoadOp::load);

/// Specialisation constants of visualizers' shaders: kEncode, 1 if the shader encodes sRGB itself; and, in shaders with
/// a heat scale, kHeatRange, the factor on its end (shaders/common/heat.glsl).
[[nodiscard]] gpu::SpecConstants visualizer_constants(FrameBuilder& frame);

/// The value at a stop of a heat scale, 0…GLOAM_HEAT_STOPS − 1, and the text of a whole scale: "black 0, blue 6, cyan
/// 12, green 19, yellow 25, red 31, white more".
[[nodiscard]] double heat_value(const HeatScale& scale, float heat_range, int stop);
[[nodiscard]] std::string heat_text(const HeatScale& scale, float heat_range);
/// A number with three significant digits, without zeros at the end.
[[nodiscard]] std::string heat_number(double value);
/// The colour at a position of a heat scale, 0…1, in linear RGB.
[[nodiscard]] vec3 heat_color(double share);

}  // namespace gloam
