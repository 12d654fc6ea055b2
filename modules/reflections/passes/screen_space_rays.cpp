// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/screen_space_rays.h"

#include "modules/lighting/outputs.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram screen_space_program(const ReflectionKnobs& knobs, bool blended, const gpu::SpecConstants& probes) {
  ComputeProgram program{
      blended ? shaders::reflections::screen_space_rays_blended_comp : shaders::reflections::screen_space_rays_comp,
      {{"kHierarchical", knobs.hierarchical ? 1u : 0u}, {"kPixelNormals", knobs.pixel_normals ? 1u : 0u}}};
  program.constants.set(probes);
  return program;
}

ScreenSpaceHits add_screen_space_pass(FrameBuilder& frame, const ReflectionKnobs& knobs,
                                      const ReflectionUniforms& uniforms, const MirrorTiles& tiles) {
  const BlendedLayer* blended = frame.find<BlendedLayer>();
  ComputePass pass(frame, "reflection_screen_space",
                   screen_space_program(knobs, blended != nullptr, probe_constants(frame.get<SurroundingProbes>())));
  pass.read("reflection", uniforms.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_surroundings(pass, frame);
  pass.read("ambient_image", frame.get<StrongAmbient>().light);
  pass.read("lit_image", frame.get<LitOutput>().color);
  if (blended != nullptr) {
    pass.read("blended_light", blended->light);
    pass.read("blended_depth", blended->depth);
  }
  const std::uint32_t scale = uniforms.constants.scale;
  ScreenSpaceHits hits;
  hits.color = pass.write("color_image", create_view_image(frame, "ssr_color", gpu::Format::rgba16_float, scale));
  hits.distance =
      pass.write("distance_image", create_view_image(frame, "ssr_distance", gpu::Format::rgba8_unorm, scale));
  dispatch_mirror_tiles(pass, tiles);
  return hits;
}

}  // namespace gloam
