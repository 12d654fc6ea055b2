// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/glossy_blur.h"

#include <utility>

#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

bool is_direct(const FrameBuilder& frame) { return frame.services().device.info().threads_in_turn; }

/// The listed tiles, or one workgroup per GLOAM_BLUR_GROUP texels of each row or column.
void dispatch(ComputePass& pass, const FrameBuilder& frame, const uvec2& size, const MirrorTiles& tiles, bool columns) {
  if (is_direct(frame)) return dispatch_mirror_tiles(pass, tiles);
  const uvec2 lines = columns ? uvec2(size.y, size.x) : size;
  pass.dispatch((lines.x + GLOAM_BLUR_GROUP - 1) / GLOAM_BLUR_GROUP, lines.y);
}

/// spread: an image that has the spread of each texel in its first channel.
ImageRef add_dilation(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                      ImageRef surface, ImageRef spread, bool columns) {
  const char* name = columns ? "reflection_dilate_y" : "reflection_dilate_x";
  ComputePass pass(frame, name, dilate_program(columns, is_direct(frame)));
  pass.read("reflection", uniforms.block);
  pass.read("spread_image", spread);
  pass.read("surface_image", surface);
  const ImageRef dilated =
      pass.write("dilated_image", create_view_image(frame, name, gpu::Format::r8_unorm, uniforms.constants.scale));
  if (is_direct(frame)) pass.read("tile_roughness", tiles.roughness);
  dispatch(pass, frame, uniforms.constants.size, tiles, columns);
  return dilated;
}

/// The picture of a blur along columns: that of the core, and below it that of the tail.
ImageRef create_columns_image(FrameBuilder& frame, const char* name, const uvec2& size) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.format = gpu::Format::rgba16_float;
  desc.width = size.x;
  desc.height = 2 * size.y;
  return frame.graph().create_image(std::move(desc));
}

MirroredLight add_blur(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                       const MirroredLight& light, ImageRef dilated, bool columns) {
  const char* name = columns ? "reflection_blur_y" : "reflection_blur_x";
  ComputePass pass(frame, name, blur_program(columns, is_direct(frame)));
  pass.read("reflection", uniforms.block);
  pass.read("dilated_image", dilated);
  pass.read("surface_image", light.surface);
  pass.read("color_image", light.color);
  const ImageRef blurred = pass.write(
      "blurred_image", columns ? create_columns_image(frame, name, uniforms.constants.size)
                               : create_view_image(frame, name, gpu::Format::rgba16_float, uniforms.constants.scale));
  dispatch(pass, frame, uniforms.constants.size, tiles, columns);
  return {blurred, light.surface};
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

MirroredLight add_glossy_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                                const MirroredLight& light, bool dilate) {
  ImageRef dilated = light.surface;
  if (dilate)
    for (const bool columns : {false, true})
      dilated = add_dilation(frame, uniforms, tiles, light.surface, dilated, columns);
  const MirroredLight in_columns = add_blur(frame, uniforms, tiles, light, dilated, true);
  return add_blur(frame, uniforms, tiles, in_columns, dilated, false);
}

}  // namespace gloam
