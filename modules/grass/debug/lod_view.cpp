// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/debug/lod_view.h"

#include <cstddef>

#include "engine/render/passes/visualizer_pass.h"
#include "modules/grass/drawing/draw_blades_passes.h"
#include "shaders/grass/shaders.h"

namespace gloam {
namespace {

DrawProgram view_program(FrameBuilder& frame, std::uint32_t draw_class) {
  DrawProgram program = blade_program(draw_class, {});
  program.fragment = shaders::grass::lod_view_frag;
  program.constants = program.constants.where_present();  // without the clip plane of the shading's fragment shader
  program.constants.set(visualizer_constants(frame));
  program.depth_write = false;
  return program;
}

}  // namespace

std::vector<VisualizerInfo> grass_visualizers() {
  return {{"grass_lod", "grass", "",
           "blades by level of detail: red 15 segments, yellow 5, green 3, blue 1; darker toward the root"}};
}

void add_grass_view_pass(FrameBuilder& frame, const GrassFrame& grass) {
  if (frame.visualizer() != "grass_lod" || grass.stored.patches.empty()) return;
  DrawPass pass(frame, "grass_lod_view", view_program(frame, 0));
  add_visualizer_targets(frame, pass, "grass_lod", gpu::Format::rgba16_float);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  for (std::uint32_t i = 0; i < GLOAM_GRASS_CLASSES; ++i) {
    if (i > 0) pass.use(view_program(frame, i));
    bind_blades(pass, grass.drawn);
    pass.draw_indexed_indirect(grass.drawn.indices, grass.drawn.draws,
                               offsetof(shaders::GrassDraws, draws) + i * sizeof(shaders::GrassDraw), 1);
  }
}

}  // namespace gloam
