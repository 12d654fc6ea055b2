// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/glossy/passes.h"

#include "modules/reflections/surfaces/pass.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

bool is_direct(const FrameBuilder& frame) { return frame.services().device.info().threads_in_turn; }

/// The listed tiles, or one workgroup per GLOAM_BLUR_GROUP texels of each row or column.
void dispatch(ComputePass& pass, const FrameBuilder& frame, const ReflectionFrame& reflections, bool columns) {
  if (is_direct(frame)) return dispatch_mirror_tiles(pass, reflections);
  const uvec2 size = reflections.constants.size;
  const uvec2 lines = columns ? uvec2(size.y, size.x) : size;
  pass.dispatch((lines.x + GLOAM_BLUR_GROUP - 1) / GLOAM_BLUR_GROUP, lines.y);
}

ImageRef add_dilation(FrameBuilder& frame, const ReflectionFrame& r, ImageRef spread, bool columns) {
  const char* name = columns ? "reflection_dilate_y" : "reflection_dilate_x";
  ComputePass pass(frame, name, dilate_program(columns, is_direct(frame)));
  pass.read("reflection", r.block);
  pass.read("spread_image", spread);
  pass.read("surface_image", r.surface);
  const ImageRef dilated =
      pass.write("dilated_image", create_view_image(frame, name, gpu::Format::r8_unorm, r.constants.scale));
  if (is_direct(frame)) pass.read("tile_roughness", r.tile_roughness);
  dispatch(pass, frame, r, columns);
  return dilated;
}

ImageRef add_blur(FrameBuilder& frame, const ReflectionFrame& r, ImageRef dilated, bool columns) {
  const char* name = columns ? "reflection_blur_y" : "reflection_blur_x";
  ComputePass pass(frame, name, blur_program(columns, is_direct(frame)));
  pass.read("reflection", r.block);
  pass.read("dilated_image", dilated);
  pass.read("surface_image", r.surface);
  pass.read("color_image", r.color);
  if (is_direct(frame)) pass.read("tile_roughness", r.tile_roughness);
  const ImageRef blurred =
      pass.write("blurred_image", create_view_image(frame, name, gpu::Format::rgba16_float, r.constants.scale));
  dispatch(pass, frame, r, columns);
  return blurred;
}

}  // namespace

ComputeProgram dilate_program(bool columns, bool direct) {
  return {direct ? shaders::reflections::dilate_tiles_comp : shaders::reflections::dilate_comp,
          {{"kColumns", columns ? 1u : 0u}}};
}

ComputeProgram blur_program(bool columns, bool direct) {
  return {direct ? shaders::reflections::blur_tiles_comp : shaders::reflections::blur_comp,
          {{"kColumns", columns ? 1u : 0u}}};
}

void add_glossy_passes(FrameBuilder& frame, ReflectionFrame& reflections) {
  const ImageRef dilated =
      add_dilation(frame, reflections, add_dilation(frame, reflections, reflections.surface, false), true);
  for (const bool columns : {true, false}) reflections.color = add_blur(frame, reflections, dilated, columns);
}

}  // namespace gloam
