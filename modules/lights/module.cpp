// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/module.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/once_log.h"
#include "engine/ecs/view.h"
#include "engine/render/camera/light_scale.h"
#include "engine/render/frame_builder.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/scene/units.h"
#include "modules/lights/debug/measures.h"
#include "modules/lights/debug/oversights.h"
#include "modules/lights/debug/pick.h"
#include "modules/lights/debug/visualizers.h"
#include "modules/lights/keys.h"
#include "modules/lights/knobs.h"
#include "modules/lights/lists/buffers.h"
#include "modules/lights/lists/find_passes.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"
#include "modules/lights/systems.h"

namespace gloam {
namespace {

/// For BrightnessSources. Lamps light surfaces that are a metre away: how far they are is not known, and is in most
/// scenes within a few powers of two of it.
double brightest_surface(const World& world) {
  const double metre = 1.0 / metres_per_unit(world);
  double most = 0.0;
  world.view<const Light>().each([&](Entity, const Light& light) {
    const double emitted = static_cast<double>(light.intensity) *
                           static_cast<double>(glm::max(glm::max(light.color.x, light.color.y), light.color.z));
    const double lux = light.kind == LightKind::directional ? emitted : emitted / (metre * metre);
    if (std::isfinite(lux)) most = std::max(most, lux);
  });
  return most / std::numbers::pi;
}

class LightsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "lights"; }

  void register_components(World& world) const override {
    world.register_component<Light>("light");
    world.register_component<LightBounds>("light_bounds");
    world.ensure_resource<LightSet>();
    world.ensure_resource<BrightnessSources>().lit[name()] = &brightest_surface;
  }
  void scene_keys(KeyRegistry& registry) const override { add_light_keys(registry); }

  void knobs(KnobRegistry& registry) const override {
    add_knobs(registry, name(), kLightCulling, kLightTileBound, kLightZBins, kFixedLightSlots, kEmitterHighlights,
              kLightCheck);
  }

  [[nodiscard]] std::vector<MeasureInfo> measures() const override { return light_measures(); }

  [[nodiscard]] std::string idle_knob(const World& world, const RenderView& view, std::string_view knob,
                                      const FrameCounters&) const override {
    if (knob == kEmitterHighlights.name) {
      bool wide = false;
      world.view<const Light>().each([&](const Light& light) {
        wide = wide || (light.kind == LightKind::directional ? light.apparent_angle : light.width_m) > 0.0f;
      });
      return wide ? "" : "no light has a width";
    }
    const VisibleLights* visible = world.try_view_resource<VisibleLights>(view.id);
    return visible != nullptr && visible->block.local_count == 0 ? "no lamp is in view" : "";
  }

  void add_systems(Schedule& schedule) override { add_light_systems(schedule); }

  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    const std::size_t count = world.view<const Light>().size();
    if (count == 0) return {false, "no light"};
    const std::string lights = std::to_string(count) + (count == 1 ? " light" : " lights");
    if (view != nullptr && !sees_surfaces(world, *view)) return {false, lights + ", only sky in view"};
    const VisibleLights* visible = view == nullptr ? nullptr : world.try_view_resource<VisibleLights>(view->id);
    if (visible != nullptr && visible->block.local_count + visible->block.directional_count == 0)
      return {false, lights + ", none in view"};
    return {true, lights};
  }

  [[nodiscard]] std::vector<Oversight> oversights(const World& world) const override { return dark_lights(world); }

  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override {
    list_light_pipelines(knobs, device, list);
  }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return light_visualizers(); }

  void prepare_view(World& world, ViewId view, const KnobRegistry& knobs) const override {
    prepare_light_view(world, view);
    world.view_resource<VisibleLights>(view).wide_highlights = wide_highlights(knobs);
    world.view_resource<TileBound>(view) = knobs.value(kLightTileBound);
    world.view_resource<ZBinSettings>(view).count = knobs.value(kLightZBins);
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::visualize) views_.add_pass(frame);
    if (phase != PassPhase::lists) return;
    const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
    if (visible.dropped > 0) {
      once_log_.warning(frame.log(), "lights.dropped",
                        "more lights are visible than fit (" + std::to_string(GLOAM_MAX_LOCAL_LIGHTS) + " local, " +
                            std::to_string(GLOAM_MAX_DIRECTIONAL_LIGHTS) + " directional): the " +
                            std::to_string(visible.dropped) + " least important are left out (counter lights.dropped)");
    }
    const auto& bins = frame.world().view_resource<ZBins>(frame.view().id);
    const auto& masks = frame.world().view_resource<TileLightMasks>(frame.view().id);
    add_find_lights_passes(frame, visible, bins, masks);
  }

  [[nodiscard]] Status add_pick_copies(FrameBuilder& frame, Captures& copies) override {
    return add_light_pick_copies(frame, copies);
  }

  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    return light_pick_lines(frame, pixel, copies);
  }

  void take_result(World& world, ViewId view, std::string_view name, const FrameResult& result) const override {
    if (name != kLightCountersResult) return;
    const auto& note = std::any_cast<const LightCountersNote&>(result.note);
    const LightFeedback feedback =
        light_feedback(result.value<shaders::LightCounters>(), note, world.try_view_resource<LightFeedback>(view));
    world.set_view_resource(view, feedback);
    if (auto* bins = world.try_view_resource<ZBinSettings>(view)) bins->farthest_opaque_m = feedback.farthest_m;
  }

  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    if (name == kLightCountersResult)
      count_lights(result.value<shaders::LightCounters>(), std::any_cast<const LightCountersNote&>(result.note), sink);
  }

  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const auto& visible = world.view_resource<VisibleLights>(view.id);
    sink.count("lights.total", visible.total);
    sink.count("lights.visible", visible.block.local_count + visible.block.directional_count);
    sink.count("lights.local", visible.block.local_count);
    sink.count("lights.dropped", visible.dropped);
  }

 private:
  OnceLog once_log_;
  LightViews views_;
};

}  // namespace

std::unique_ptr<Module> make_lights_module() { return std::make_unique<LightsModule>(); }

}  // namespace gloam
