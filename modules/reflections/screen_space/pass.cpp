// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/screen_space/pass.h"

#include "modules/reflections/surfaces/pass.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram screen_space_program(const ReflectionKnobs& knobs) {
  return {shaders::reflections::trace_comp, {{"kHierarchical", knobs.hierarchical ? 1u : 0u}}};
}

void add_screen_space_pass(FrameBuilder& frame, ReflectionFrame& reflections) {
  ComputePass pass(frame, "reflection_screen_space", screen_space_program(reflections.knobs));
  pass.read("reflection", reflections.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("lit_image", frame.get<LitOutput>().color);
  const std::uint32_t scale = reflections.constants.scale;
  reflections.ssr_color =
      pass.write("color_image", create_view_image(frame, "ssr_color", gpu::Format::rgba16_float, scale));
  reflections.ssr_distance =
      pass.write("distance_image", create_view_image(frame, "ssr_distance", gpu::Format::rgba8_unorm, scale));
  dispatch_mirror_tiles(pass, reflections);
}

}  // namespace gloam
