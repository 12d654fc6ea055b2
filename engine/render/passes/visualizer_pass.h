// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/render/declare/draw_pass.h"

namespace gloam {

/// Declares the targets of a visualizer's pass: the view's picture, which it is drawn over (or in place of:
/// LoadOp::clear), and a new transient image `name` of the view's size, cleared to 0, for plain values that tests and
/// tools read.
void add_visualizer_targets(FrameBuilder& frame, DrawPass& pass, std::string name, gpu::Format values,
                            gpu::LoadOp picture = gpu::LoadOp::load);

/// Specialisation constant 0 of visualizers' shaders: whether the shader encodes sRGB itself.
[[nodiscard]] gpu::SpecConstant encoding_constant(FrameBuilder& frame);

}  // namespace gloam
