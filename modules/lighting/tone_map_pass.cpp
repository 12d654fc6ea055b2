// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/scene/resources.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

/// Meters the frame's light into an exposure slot.
void add_meter_pass(FrameBuilder& frame, BufferRef& slots, std::uint32_t slot) {
  ComputePass pass(frame, "meter", shaders::lighting::meter_comp);
  pass.read("lit_image", frame.get<LitOutput>().color);
  slots = pass.write("exposures", slots);
  pass.push(shaders::MeterConstants{{frame.view().width, frame.view().height}, slot});
  pass.dispatch(1);
}

/// The chosen tone curve as a table; none if lighting.tone_map_table = exact.
ImageRef add_tone_table_pass(FrameBuilder& frame) {
  static constexpr std::uint32_t kSizes[] = {0, 1024, 256, 64};  // indexed by the choice of lighting.tone_map_table
  const std::uint32_t size = kSizes[frame.knobs().choice("lighting.tone_map_table")];
  if (size == 0) return {};
  gpu::ImageDesc desc;
  desc.name = "tone_table";
  desc.module = "lighting";
  desc.format = gpu::Format::rgba16_float;
  desc.width = size;
  ComputePass pass(frame, "tone_table", shaders::lighting::tone_table_comp);
  const ImageRef table = pass.write("table_image", frame.graph().create_image(desc));
  pass.push(shaders::ToneTableConstants{frame.knobs().choice("lighting.tone_map"), size});
  pass.dispatch_over(size);
  return table;
}

}  // namespace

void add_tone_map_passes(FrameBuilder& frame, ExposureSlots& exposures) {
  if (!frame.check(exposures.prepare(frame.services().device))) return;
  const auto& environment = frame.world().resource<SceneEnvironment>();
  BufferRef& slots = exposures.in(frame.graph());
  TargetOutput& target = frame.get<TargetOutput>();

  shaders::ToneMapConstants constants{};
  constants.curve = frame.knobs().choice("lighting.tone_map");
  constants.encode_srgb = gpu::encodes_srgb(target.format) ? 0 : 1;
  if (environment.has_exposure) {
    constants.exposure = exposure_from_ev100(environment.exposure_ev100);
  } else {
    const ExposureSlots::Slot slot = exposures.slot_of(frame.world().resource<LightingWorld>(), frame.view());
    constants.exposure_slot = slot.index;
    constants.metered = 1;
    if (slot.fresh) add_meter_pass(frame, slots, slot.index);
  }

  const ImageRef table = add_tone_table_pass(frame);
  DrawPass pass(frame, "tone_map", {shaders::lighting::tone_map_frag, {{0, table ? 1u : 0u}}});
  pass.read("lit_image", frame.get<LitOutput>().color);
  pass.read("exposures", slots);
  pass.read("table_image", table, Sampling::linear);
  pass.push(constants);
  target.color = pass.target(target.color);
  pass.draw_triangle();
}

}  // namespace gloam
