// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/metering.h"

#include <any>
#include <cmath>
#include <map>

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

/// Which camera's exposure a result is.
struct ExposureNote {
  std::uint64_t camera = 0;
};

/// View resource: the exposures that frames of the view have metered, by camera. Fixed ones are metered once only.
struct MeteredExposures {
  std::map<std::uint64_t, double> ev100;
};

std::uint64_t camera_of(const RenderView& view) {
  return std::uint64_t{view.camera_entity.generation} << 32 | view.camera_entity.index;
}

double ev100_of(const FrameResult& result) {
  return -std::log2(1.2 * static_cast<double>(result.value<shaders::MeteredExposure>().exposure));
}

/// The metered exposure of the view's camera. It stays for as long as frames show the camera: History destroys it
/// later.
Result<HistoryBuffer> metered_buffer(FrameBuilder& frame) {
  gpu::BufferDesc desc;
  desc.name = "exposure";
  desc.module = "lighting";
  desc.size = sizeof(shaders::MeteredExposure);
  desc.usage = gpu::BufferUsage::storage | gpu::BufferUsage::transfer_source;
  return frame.history_buffer(
      desc,
      {.scope = HistoryScope::view, .final_access = gpu::Access::fragment_read, .instance = camera_of(frame.view())});
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
    if (!metered->filled() || mode != ExposureMode::fixed) {
      add_meter_pass(frame, metered->buffer, mode, !metered->filled());
      frame.keep_result("lighting", kExposureResult, metered->buffer, ExposureNote{camera_of(frame.view())});
    }
  }
  exposure.buffer = metered->buffer;
  return exposure;
}

void take_metered_exposure(World& world, ViewId view, std::string_view result_name, const FrameResult& result) {
  if (result_name != kExposureResult) return;
  if (world.try_view_resource<MeteredExposures>(view) == nullptr) world.set_view_resource(view, MeteredExposures{});
  const auto note = std::any_cast<ExposureNote>(result.note);
  world.view_resource<MeteredExposures>(view).ev100[note.camera] = ev100_of(result);
}

void count_exposure(const World& world, const RenderView& view, CounterSink& sink) {
  constexpr const char* kCounter = "lighting.exposure_ev100";
  if (has_stated_exposure(world))
    return sink.count(kCounter, static_cast<double>(world.resource<SceneEnvironment>().exposure_ev100));
  const auto* metered = world.try_view_resource<MeteredExposures>(view.id);
  if (metered == nullptr) return;
  const auto found = metered->ev100.find(camera_of(view));
  if (found != metered->ev100.end()) sink.count(kCounter, found->second);
}

void count_metered_exposure(std::string_view result_name, const FrameResult& result, CounterSink& sink) {
  if (result_name == kExposureResult) sink.count("lighting.exposure_ev100", ev100_of(result));
}

}  // namespace gloam
