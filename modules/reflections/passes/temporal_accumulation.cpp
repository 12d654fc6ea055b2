// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/temporal_accumulation.h"

#include <bit>
#include <cstdint>

#include "engine/render/camera/view_constants.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

constexpr float kNewShare = 0.15f;  // of a frame in the accumulated reflection

}  // namespace

ComputeProgram temporal_program() { return {shaders::reflections::temporal_accumulation_comp}; }

MirroredLight add_temporal_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                                const MirroredLight& light) {
  gpu::ImageDesc desc;
  desc.name = "reflection_history";
  desc.module = "reflections";
  desc.format = gpu::Format::rgba16_float;
  desc.width = uniforms.constants.size.x;
  desc.height = uniforms.constants.size.y;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage;
  const auto scale = std::bit_cast<std::uint32_t>(frame.view().light_scale);  // of the light in the images
  const auto kept = frame.history_image_pair(
      desc, {.final_access = gpu::Access::compute_read, .reset = {.camera_cut = true, .most_missed = 0, .key = scale}});
  if (!frame.check(kept)) return light;
  const bool known = kept->valid() && frame.view().has_previous;
  ComputePass pass(frame, "reflection_temporal", temporal_program());
  pass.read("reflection", uniforms.block);
  pass.uniform("motion", motion_constants(frame.view()));
  pass.read("mirror_image", tiles.image);
  pass.read("surface_image", light.surface);
  pass.read("color_image", light.color);
  pass.read("previous_image", known ? kept->previous : ImageRef{}, Sampling::linear);
  pass.push(known ? kNewShare : 1.0f);
  const ImageRef accumulated = pass.write("accumulated_image", kept->current);
  pass.dispatch_over(uniforms.constants.size);
  return {accumulated, light.surface};
}

}  // namespace gloam
