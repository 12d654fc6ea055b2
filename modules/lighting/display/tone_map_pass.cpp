// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/antialiasing/smooth_edges_passes.h"
#include "modules/lighting/antialiasing/temporal_passes.h"
#include "modules/lighting/display/metering.h"
#include "modules/lighting/knobs.h"
#include "modules/lighting/lighting_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

shaders::ScatteredConstants constants_of(const ScatteredLight& scattered) {
  return {scattered.uv_scale, scattered.uv_offset, scattered.share};
}

/// What the camera's lens scatters; of a null image if it scatters nothing.
ScatteredLight scattered_light(const FrameBuilder& frame) {
  const auto* found = frame.find<ScatteredLight>();
  return found != nullptr ? *found : ScatteredLight{};
}

/// The curve's number in tone_curve.glsl.
std::uint32_t tone_curve_of(const FrameBuilder& frame) {
  return static_cast<std::uint32_t>(frame.knobs().value(kToneMap));
}

/// The chosen tone curve as a table; none if lighting.tone_map_table = exact.
ImageRef add_tone_table_pass(FrameBuilder& frame) {
  const std::uint32_t size = frame.knobs().value(kToneMapTable);
  if (size == 0) return {};
  gpu::ImageDesc desc;
  desc.name = "tone_table";
  desc.module = "lighting";
  desc.format = gpu::Format::rgba16_float;
  desc.width = size;
  ComputePass pass(frame, "tone_table", shaders::lighting::tone_table_comp);
  const ImageRef table = pass.write("table_image", frame.graph().create_image(desc));
  pass.push(shaders::ToneTableConstants{tone_curve_of(frame), size});
  pass.dispatch_over(size);
  return table;
}

}  // namespace

void add_tone_map_passes(FrameBuilder& frame) {
  const FrameExposure exposure = add_exposure_passes(frame);
  if (!frame.status().ok()) return;
  TargetOutput& target = frame.get<TargetOutput>();

  const ScatteredLight scattered = scattered_light(frame);
  shaders::ToneMapConstants constants{};
  constants.scattered = constants_of(scattered);
  constants.curve = tone_curve_of(frame);
  constants.encode_srgb = gpu::encodes_srgb(target.format) ? 0 : 1;
  constants.exposure = exposure.factor;
  constants.metered = exposure.metered ? 1 : 0;

  const ImageRef table = add_tone_table_pass(frame);
  const bool temporal = accumulates(frame), smooth = !temporal && antialiases(frame),
             dither = frame.knobs().value(kDither);
  const std::uint32_t output = temporal ? 2u : (smooth ? 1u : 0u);  // kOutput of tone_map.frag
  ImageRef shown = temporal || smooth ? create_view_image(frame, "shown", kShownFormat) : ImageRef{};
  {
    DrawPass pass(frame, "tone_map",
                  {shaders::lighting::tone_map_frag,
                   {{"kTable", table ? 1u : 0u},
                    {"kOutput", output},
                    {"kScattered", scattered.light ? 1u : 0u},
                    {"kDither", dither ? 1u : 0u}}});
    pass.read("lit_image", frame.get<LitOutput>().color);
    pass.read("metered_exposure", exposure.buffer);
    pass.read("table_image", table, Sampling::linear);
    pass.read("scattered_image", scattered.light, Sampling::linear);
    pass.push(constants);
    if (!temporal) target.color = pass.target(target.color);
    if (shown) shown = pass.target(shown);
    pass.draw_triangle();
  }
  if (temporal) return add_temporal_passes(frame, shown, dither);
  if (smooth) add_antialiasing_passes(frame, shown, dither);
}

}  // namespace gloam
