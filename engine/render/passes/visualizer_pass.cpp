// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/visualizer_pass.h"

#include <utility>

namespace gloam {

void add_visualizer_targets(FrameBuilder& frame, DrawPass& pass, std::string name, gpu::Format values,
                            gpu::LoadOp picture) {
  ImageRef& color = frame.get<TargetOutput>().color;
  color = pass.target(color, picture);
  frame.expose(pass.target(create_view_image(frame, std::move(name), values), gpu::LoadOp::clear));
}

gpu::SpecConstant encoding_constant(FrameBuilder& frame) {
  return {0, gpu::encodes_srgb(frame.get<TargetOutput>().format) ? 0u : 1u};
}

}  // namespace gloam
