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

/// A number in the legend of a heat scale.
struct HeatTick {
  double share = 0.0;  ///< place on the scale, 0…1
  std::string text;    ///< three significant digits at most; the last one is followed by the unit
};
/// Ticks of a legend, from 0 up. Scales of counts have whole numbers at equal steps, at most GLOAM_HEAT_STOPS of them;
/// the scale's end has none if it is no multiple of the step. Other scales have a tick at each stop of the colours.
[[nodiscard]] std::vector<HeatTick> heat_ticks(const HeatScale& scale, float heat_range);
/// The colour at a position of a heat scale, 0…1, in linear RGB.
[[nodiscard]] vec3 heat_color(double share);

}  // namespace gloam
