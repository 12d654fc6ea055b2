// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/composite/pass.h"

#include <algorithm>
#include <array>

#include "modules/lighting/outputs.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/surfaces/pass.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

DrawProgram composite_program(bool mirror, std::size_t probes, bool tiles, bool traced) {
  DrawProgram program{shaders::reflections::composite_frag,
                      {{"kMirror", mirror ? 1u : 0u},
                       {"kProbes", static_cast<std::uint32_t>(std::min<std::size_t>(probes, GLOAM_FEW_PROBES + 1))},
                       {"kTraced", traced ? 1u : 0u}}};
  program.blend = gpu::BlendMode::additive;
  program.depth_compare = gpu::CompareOp::less;  // drawn at the depth of the sky: surfaces only
  if (tiles) program.vertex = shaders::reflections::tiles_vert;
  return program;
}

ComputeProgram sharpen_program(bool screen_space) {
  return {shaders::reflections::sharpen_comp, {{"kColumns", 1u}, {"kScreenSpace", screen_space ? 1u : 0u}}};
}

void add_sharpen_pass(FrameBuilder& frame, ReflectionFrame& reflections) {
  ComputePass pass(frame, "reflection_sharpen", sharpen_program(static_cast<bool>(reflections.ssr_color)));
  pass.read("reflection", reflections.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("color_image", reflections.color);
  pass.read("surface_image", reflections.surface);
  pass.read("ssr_color", reflections.ssr_color);
  pass.read("lit_image", frame.get<LitOutput>().color);
  reflections.upscaled =
      pass.write("upscaled_image", create_view_image(frame, "reflection_upscaled", gpu::Format::rgba16_float));
  dispatch_mirror_tiles(pass, reflections);
}

void add_composite_pass(FrameBuilder& frame, const ReflectionFrame& reflections) {
  const std::size_t probes = reflections.probes.size();
  const bool traced = reflections.traced != nullptr;
  DrawPass pass(frame, "reflection_composite",
                composite_program(reflections.mirror, probes, reflections.mirror, traced));
  LitOutput& lit = frame.get<LitOutput>();
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  pass.read("reflection", reflections.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_lighting(pass, frame);
  pass.read("upscaled_image", reflections.upscaled);
  pass.read("tiles", reflections.tiles);
  pass.read("probe_images", reflections.probe_images, Sampling::linear);
  bind_rows(pass, "probe_rows", reflections.probes);
  std::array<shaders::ProbeRow, GLOAM_FEW_PROBES> few{};
  std::copy_n(reflections.probes.begin(), std::min(probes, few.size()), few.begin());
  pass.uniform("few_probes", few);
  pass.read("traced_image", reflections.traced_image);
  read_changed_lights(pass, frame, reflections);
  if (!reflections.mirror) return pass.draw_triangle();
  // Tiles without a mirror surface are drawn with a shorter shader.
  pass.read("tile_roughness", reflections.tile_roughness);
  pass.draw(6, reflections.tile_count);
  pass.use(composite_program(false, probes, true, traced));
  pass.draw(6, reflections.tile_count);
}

}  // namespace gloam
