// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/temporal_accumulation.h"

#include <bit>
#include <cstdint>

#include "engine/render/camera/view_constants.h"
#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

/// Of values that the light in the images depends on: with others, nothing is kept.
std::uint64_t light_key(const RenderView& view, const ReflectionKnobs& knobs, std::uint64_t captures) {
  const auto bits = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value)}; };
  std::uint64_t key = 0;
  for (const std::uint64_t value :
       {bits(view.light_scale), bits(knobs.k1), bits(knobs.k2), bits(knobs.reach_m), captures,
        std::uint64_t{knobs.refine}, std::uint64_t{knobs.layers}, static_cast<std::uint64_t>(knobs.mode),
        std::uint64_t{knobs.screen_space}, std::uint64_t{knobs.proxies}, std::uint64_t{knobs.light_scale},
        std::uint64_t{knobs.hierarchical}, std::uint64_t{knobs.sort}, std::uint64_t{knobs.pixel_normals}})
    key = (std::rotl(key, 29) ^ value) * 0x9E3779B97F4A7C15u;
  return key;
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
                                const MirroredLight& light, const ReflectionKnobs& knobs, std::uint64_t captures) {
  const uvec2& size = uniforms.constants.size;
  const HistoryUse use{
      .final_access = gpu::Access::compute_read,
      .reset = {.camera_cut = true, .most_missed = 0, .key = light_key(frame.view(), knobs, captures)}};
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
