// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/composite.h"

#include <algorithm>
#include <array>

#include "modules/lighting/outputs.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

DrawProgram composite_program(bool mirror, std::size_t probes, bool tiles, bool traced) {
  DrawProgram program{shaders::reflections::composite_frag,
                      {{"kMirror", mirror ? 1u : 0u},
                       {"kProbes", static_cast<std::uint32_t>(std::min<std::size_t>(probes, GLOAM_FEW_PROBES + 1))},
                       {"kTraced", traced ? 1u : 0u}}};
  program.blend = gpu::BlendMode::additive;
  program.depth_compare = gpu::CompareOp::less;  // drawn at the depth of the sky: surfaces only
  if (tiles) program.vertex = shaders::reflections::composite_tiles_vert;
  return program;
}

ComputeProgram sharpen_program(bool screen_space) {
  return {shaders::reflections::sharpen_comp, {{"kColumns", 1u}, {"kScreenSpace", screen_space ? 1u : 0u}}};
}

ImageRef add_sharpen_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                          const ScreenSpaceHits& hits, const MirroredLight& light) {
  ComputePass pass(frame, "reflection_sharpen", sharpen_program(static_cast<bool>(hits.color)));
  pass.read("reflection", uniforms.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("color_image", light.color);
  pass.read("surface_image", light.surface);
  pass.read("ssr_color", hits.color);
  pass.read("ssr_distance", hits.distance);
  pass.read("lit_image", frame.get<LitOutput>().color);
  const ImageRef upscaled =
      pass.write("upscaled_image", create_view_image(frame, "reflection_upscaled", gpu::Format::rgba16_float));
  dispatch_mirror_tiles(pass, tiles);
  return upscaled;
}

void add_composite_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const CompositeInputs& inputs) {
  const std::size_t probes = inputs.probes.rows.size();
  const bool mirror = static_cast<bool>(inputs.upscaled);
  const bool traced = static_cast<bool>(inputs.traced);
  DrawPass pass(frame, "reflection_composite", composite_program(mirror, probes, mirror, traced));
  LitOutput& lit = frame.get<LitOutput>();
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  pass.read("reflection", uniforms.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_lighting(pass, frame);
  pass.read("upscaled_image", inputs.upscaled);
  pass.read("tiles", uniforms.tiles);
  pass.read("probe_images", inputs.probes.images, Sampling::linear);
  bind_rows(pass, "probe_rows", inputs.probes.rows);
  std::array<shaders::ProbeRow, GLOAM_FEW_PROBES> few{};
  std::copy_n(inputs.probes.rows.begin(), std::min(probes, few.size()), few.begin());
  pass.uniform("few_probes", few);
  pass.read("traced_image", inputs.traced);
  read_changed_lights(pass, frame, inputs.probes.changed);
  if (!mirror) return pass.draw_triangle();
  // Tiles without a mirror surface are drawn with a shorter shader.
  pass.read("tile_roughness", inputs.tiles.roughness);
  pass.draw(6, inputs.tiles.count);
  pass.use(composite_program(false, probes, true, traced));
  pass.draw(6, inputs.tiles.count);
}

}  // namespace gloam
