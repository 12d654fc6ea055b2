// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/metering.h"

#include <cmath>

#include "engine/render/camera/light_scale.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/scene/resources.h"
#include "modules/lighting/display/exposure.h"
#include "modules/lighting/knobs.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

constexpr const char* kExposureResult = "exposure";

/// The metered exposure of the view's camera. It stays for as long as frames show the camera: History destroys it
/// later.
Result<HistoryBuffer> metered_buffer(FrameBuilder& frame) {
  gpu::BufferDesc desc;
  desc.name = "exposure";
  desc.module = "lighting";
  desc.size = sizeof(shaders::MeteredExposure);
  desc.usage = gpu::BufferUsage::storage | gpu::BufferUsage::transfer_source;
  const Entity camera = frame.view().camera_entity;
  return frame.history_buffer(desc, {.scope = HistoryScope::view,
                                     .final_access = gpu::Access::fragment_read,
                                     .instance = std::uint64_t{camera.generation} << 32 | camera.index});
}

/// The share of its way to the right exposure, in stops, that an exposure goes in dt_s.
float share_of_way(double dt_s, double time_constant_s) {
  return static_cast<float>(-std::expm1(-std::max(dt_s, 0.0) / time_constant_s));
}

/// Meters the frame's light. begins: the exposure is that of the light at once.
void add_meter_pass(FrameBuilder& frame, BufferRef& exposure, ExposureMode mode, bool begins) {
  const RenderView& view = frame.view();
  shaders::MeterConstants constants{};
  constants.size = {view.width, view.height};
  constants.inverse_scale = 1.0f / view.light_scale;
  constants.frame = static_cast<std::uint32_t>(view.frame);
  constants.begins = begins ? 1 : 0;
  constants.to_bright = constants.to_dark = 1.0f;
  if (mode == ExposureMode::adapting) {
    const double dt_s = frame.world().resource<SceneClock>().dt_s;
    constants.to_bright = share_of_way(dt_s, kToBrightS);
    constants.to_dark = share_of_way(dt_s, kToDarkS);
  }
  ComputePass pass(frame, "meter", shaders::lighting::meter_comp);
  pass.read("lit_image", frame.get<LitOutput>().color);
  exposure = pass.write("metered", exposure);
  pass.push(constants);
  pass.dispatch(1);
}

}  // namespace

void choose_exposure(World& world, const KnobRegistry& knobs) {
  if (knobs.value(kExposure) != ExposureMode::fixed)
    world.ensure_resource<MeteredInEveryFrame>();
  else
    world.remove_resource<MeteredInEveryFrame>();
}

FrameExposure add_exposure_passes(FrameBuilder& frame) {
  auto metered = metered_buffer(frame);
  if (!frame.check(metered)) return {};
  FrameExposure exposure{.factor = 1.0f / frame.view().light_scale};
  if (has_stated_exposure(frame.world())) {
    exposure.factor *= exposure_from_ev100(frame.world().resource<SceneEnvironment>().exposure_ev100);
  } else {
    exposure.metered = true;
    const ExposureMode mode = frame.world().try_resource<MeteredInEveryFrame>() == nullptr
                                  ? ExposureMode::fixed
                                  : frame.knobs().value(kExposure);
    if (!metered->filled() || mode != ExposureMode::fixed)
      add_meter_pass(frame, metered->buffer, mode, !metered->filled());
    frame.keep_result("lighting", kExposureResult, metered->buffer);
  }
  exposure.buffer = metered->buffer;
  return exposure;
}

void count_exposure(const World& world, CounterSink& sink) {
  if (has_stated_exposure(world))
    sink.count("lighting.exposure_ev100", static_cast<double>(world.resource<SceneEnvironment>().exposure_ev100));
}

void count_metered_exposure(std::string_view result_name, const FrameResult& result, CounterSink& sink) {
  if (result_name != kExposureResult) return;
  const double exposure = static_cast<double>(result.value<shaders::MeteredExposure>().exposure);
  sink.count("lighting.exposure_ev100", -std::log2(1.2 * exposure));
}

}  // namespace gloam
