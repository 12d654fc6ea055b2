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

/// Of the knobs' values: a picture with other values begins anew.
std::uint64_t knobs_key(const KnobRegistry& knobs) {
  Hasher hasher;
  for (const Knob& knob : knobs.knobs()) hasher.bytes_of(knobs.number(knob));
  return hasher.digest();
}

gpu::ImageDesc kept_image(const FrameBuilder& frame, const char* name, gpu::Format format) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.format = format;
  desc.width = frame.view().width;
  desc.height = frame.view().height;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage;
  return desc;
}

}  // namespace

bool accumulates(const FrameBuilder& frame) {
  return frame.knobs().value(kAntialiasing) == Antialiasing::taa && frame.view().jittered && antialiases(frame);
}

void add_temporal_passes(FrameBuilder& frame, ImageRef shown, bool dither) {
  const uvec2 size(frame.view().width, frame.view().height);
  const HistoryUse use{.reset = {.camera_cut = true, .most_missed = 0, .key = knobs_key(frame.knobs())}};
  const auto light = frame.history_image_pair(kept_image(frame, "antialiasing_light", gpu::Format::rgba16_float), use);
  const auto motion = frame.history_image_pair(kept_image(frame, "antialiasing_motion", gpu::Format::rg16_float), use);
  if (!frame.check(light) || !frame.check(motion)) return;
  const bool known = light->valid() && motion->valid();
  const GeometryOutputs& geometry = frame.get<GeometryOutputs>();
  ComputePass resolve(frame, "antialiasing_temporal", shaders::lighting::temporal_comp);
  resolve.read("shown_image", shown);
  resolve.read("depth_image", geometry.depth);
  resolve.read("motion_image", geometry.motion);
  resolve.read("previous_image", known ? light->previous : ImageRef{}, Sampling::linear);
  resolve.read("previous_motion", known ? motion->previous : ImageRef{});
  const ImageRef accumulated = resolve.write("accumulated_image", light->current);
  const ImageRef kept_motion = resolve.write("kept_motion", motion->current);
  resolve.push(shaders::TemporalConstants{size, known ? 1u : 0u});
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
