// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/antialiasing/temporal_passes.h"

#include <cstdint>

#include "engine/core/hash.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/views/seen_surfaces.h"
#include "modules/lighting/antialiasing/smooth_edges_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// Of the knobs of look: a picture with other values begins anew. Other knobs are other ways to the same picture, and a
/// time budget changes them while the camera moves.
std::uint64_t look_key(const KnobRegistry& knobs) {
  Hasher hasher;
  for (const Knob& knob : knobs.knobs())
    if (knob.is_look) hasher.bytes_of(knobs.number(knob));
  return hasher.digest();
}

uvec2 picture_size(FrameBuilder& frame) {
  const gpu::ImageDesc& desc = frame.graph().desc(frame.get<TargetOutput>().color);
  return {desc.width, desc.height};
}

bool enlarges(FrameBuilder& frame) { return picture_size(frame) != uvec2(frame.view().width, frame.view().height); }

gpu::ImageDesc kept_image(FrameBuilder& frame, const char* name, gpu::Format format) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.format = format;
  desc.width = picture_size(frame).x;
  desc.height = picture_size(frame).y;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage;
  return desc;
}

}  // namespace

bool accumulates(FrameBuilder& frame) {
  if (enlarges(frame)) return true;
  return frame.knobs().value(kAntialiasing) == Antialiasing::taa && frame.view().jittered && antialiases(frame);
}

void add_temporal_passes(FrameBuilder& frame, ImageRef shown, bool dither) {
  const RenderView& view = frame.view();
  const uvec2 size = picture_size(frame);
  const HistoryUse use{.reset = {.camera_cut = true, .most_missed = 0, .key = look_key(frame.knobs())}};
  const auto light = frame.history_image_pair(kept_image(frame, "antialiasing_light", gpu::Format::rgba16_float), use);
  const auto motion = frame.history_image_pair(kept_image(frame, "antialiasing_motion", gpu::Format::rg16_float), use);
  if (!frame.check(light) || !frame.check(motion)) return;
  const bool known = light->valid() && motion->valid();
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  ComputePass resolve(frame, "antialiasing_temporal",
                      {shaders::lighting::temporal_comp, {{"kEnlarges", enlarges(frame) ? 1u : 0u}}});
  resolve.read("shown_image", shown);
  resolve.read("depth_image", geometry.depth);
  resolve.read("motion_image", geometry.motion);
  resolve.read("previous_image", known ? light->previous : ImageRef{}, Sampling::linear);
  resolve.read("previous_motion", known ? motion->previous : ImageRef{});
  const ImageRef accumulated = resolve.write("accumulated_image", light->current);
  const ImageRef kept_motion = resolve.write("kept_motion", motion->current);
  resolve.push(shaders::TemporalConstants{size, {view.width, view.height}, view.jitter, known ? 1u : 0u});
  resolve.dispatch_over(size);

  TargetOutput& target = frame.get<TargetOutput>();
  DrawPass sharpen(frame, "antialiasing_sharpen", {shaders::lighting::sharpen_frag, {{"kDither", dither ? 1u : 0u}}});
  sharpen.read("accumulated_image", accumulated);
  sharpen.read("kept_motion", kept_motion);
  sharpen.push(shaders::AntialiasingConstants{size, gpu::encodes_srgb(target.format) ? 0u : 1u});
  target.color = sharpen.target(target.color);
  sharpen.draw_triangle();
}

}  // namespace gloam
