// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/passes.h"
#include "shaders/render/shaders.h"

namespace gloam {

void add_copy_light_pass(FrameBuilder& frame, ImageRef from, ImageRef to) {
  DrawPass pass(frame, "copy_light", {shaders::render::copy_light_frag});
  pass.read("lit_image", from);
  static_cast<void>(pass.target(to));
  pass.draw_triangle();
}

}  // namespace gloam
