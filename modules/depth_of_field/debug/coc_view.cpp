// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/debug/coc_view.h"

#include "engine/render/passes/visualizer_pass.h"
#include "modules/depth_of_field/reference/lens_reference.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

std::vector<VisualizerInfo> dof_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"dof_coc", "depth_of_field", "",
       "radius of the circle of confusion: green in focus, blue behind the focus, orange before it, brightest at "
       "dof.radius"},
      {"dof_reference", "depth_of_field", "", "the picture through the lens, accumulated from points of the aperture"}};
  views.back().trace = &put_lens_picture;
  return views;
}

void add_dof_view_pass(FrameBuilder& frame, const DofFrame& dof) {
  if (frame.visualizer() != "dof_coc") return;
  DrawPass pass(frame, "dof_coc_view", {shaders::depth_of_field::coc_view_frag, visualizer_constants(frame)});
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  add_visualizer_targets(frame, pass, "dof_coc", gpu::Format::rgba16_float);
  pass.draw_triangle();
}

}  // namespace gloam
