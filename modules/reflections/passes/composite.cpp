// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/composite.h"

#include "modules/lighting/outputs.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram composite_program(bool screen_space, bool bumpy, bool centered) {
  return {shaders::reflections::composite_comp,
          {{"kColumns", 1u},
           {"kScreenSpace", screen_space ? 1u : 0u},
           {"kBumpy", bumpy ? 1u : 0u},
           {"kCentered", centered ? 1u : 0u}}};
}

void add_composite_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorSurfaces& surfaces,
                        const ScreenSpaceHits& hits, const MirroredLight& light, bool bends) {
  const bool screen_space = static_cast<bool>(hits.color);
  const bool centered = uniforms.constants.centered != 0;
  ComputePass pass(frame, "reflection_composite", composite_program(screen_space, false, centered));
  pass.read("reflection", uniforms.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_surroundings(pass, frame);
  pass.read("ambient_image", frame.get<StrongAmbient>().light);
  pass.read("color_image", light.color);
  pass.read("surface_image", light.surface);
  pass.read("ssr_color", hits.color);
  pass.read("ssr_distance", hits.distance);
  LitOutput& lit = frame.get<LitOutput>();
  lit.color = pass.write("lit_image", lit.color);
  dispatch_mirror_tiles(pass, surfaces.tiles, GLOAM_LIST_FLAT);
  if (bends) pass.use(composite_program(screen_space, true, centered));
  dispatch_mirror_tiles(pass, surfaces.tiles, GLOAM_LIST_BUMPY);
}

void add_traced_light_pass(FrameBuilder& frame, ImageRef traced) {
  DrawProgram program{shaders::reflections::traced_light_frag};
  program.blend = gpu::BlendMode::additive;
  program.depth_compare = gpu::CompareOp::less;  // drawn at the depth of the sky: surfaces only
  DrawPass pass(frame, "reflection_traced_light", program);
  LitOutput& lit = frame.get<LitOutput>();
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_surroundings(pass, frame);
  pass.read("traced_image", traced);
  pass.draw_triangle();
}

}  // namespace gloam
