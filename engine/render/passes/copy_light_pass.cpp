// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/renderer_passes.h"
#include "shaders/render/shaders.h"

namespace gloam {

ImageRef add_copy_light_pass(FrameBuilder& frame, ImageRef from, ImageRef to, std::uint32_t mip, std::uint32_t layer) {
  DrawPass pass(frame, "copy_light", {shaders::render::copy_light_frag});
  pass.read("lit_image", from);
  to = pass.target(to, gpu::LoadOp::discard, mip, layer);
  pass.draw_triangle();
  return to;
}

}  // namespace gloam
