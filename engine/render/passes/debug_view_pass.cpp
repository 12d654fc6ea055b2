// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/renderer_passes.h"
#include "shaders/render/shaders.h"

namespace gloam {

void add_debug_view_pass(FrameBuilder& frame, std::uint32_t code) {
  frame.upload_view_constants(code);
  TargetOutput& target = frame.get<TargetOutput>();
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  DrawPass pass(frame, "debug_view",
                {.fragment = shaders::render::debug_view_frag,
                 .constants = {{"kEncode", gpu::encodes_srgb(target.format) ? 0u : 1u}}});
  pass.read("base_color_image", geometry.base_color);
  pass.read("normal_image", geometry.normals);
  pass.read("depth_image", geometry.depth);
  target.color = pass.target(target.color);
  pass.draw_triangle();
}

}  // namespace gloam
