// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/temporal_accumulation.h"

#include <bit>
#include <cstdint>

#include "engine/render/camera/view_constants.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

HistoryUse kept_images(const RenderView& view) {
  const auto scale = std::bit_cast<std::uint32_t>(view.light_scale);  // of the light in the images
  return {.final_access = gpu::Access::compute_read, .reset = {.camera_cut = true, .most_missed = 0, .key = scale}};
}

gpu::ImageDesc kept_image(const char* name, gpu::Format format, const uvec2& size) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "reflections";
  desc.format = format;
  desc.width = size.x;
  desc.height = size.y;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage;
  return desc;
}

}  // namespace

ComputeProgram temporal_program() { return {shaders::reflections::temporal_accumulation_comp}; }

MirroredLight add_temporal_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms, const MirrorTiles& tiles,
                                const MirroredLight& light) {
  const uvec2& size = uniforms.constants.size;
  const HistoryUse use = kept_images(frame.view());
  const auto kept = frame.history_image_pair(kept_image("reflection_history", gpu::Format::rgba16_float, size), use);
  const auto counts =
      frame.history_image_pair(kept_image("reflection_history_count", gpu::Format::rgba8_unorm, size), use);
  if (!frame.check(kept) || !frame.check(counts)) return light;
  const bool known = kept->valid() && counts->valid() && frame.view().has_previous;
  ComputePass pass(frame, "reflection_temporal", temporal_program());
  pass.read("reflection", uniforms.block);
  pass.uniform("motion", motion_constants(frame.view()));
  pass.read("mirror_image", tiles.image);
  pass.read("surface_image", light.surface);
  pass.read("color_image", light.color);
  pass.read("previous_image", known ? kept->previous : ImageRef{}, Sampling::linear);
  pass.read("previous_count", known ? counts->previous : ImageRef{});
  pass.push(known ? 1u : 0u);
  const ImageRef accumulated = pass.write("accumulated_image", kept->current);
  static_cast<void>(pass.write("count_image", counts->current));
  pass.dispatch_over(size);
  return {accumulated, light.surface};
}

}  // namespace gloam
