// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/module.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/camera/view_constants.h"
#include "engine/render/worlds/world_id.h"
#include "modules/lighting/antialiasing/reference.h"
#include "modules/lighting/antialiasing/temporal_passes.h"
#include "modules/lighting/components.h"
#include "modules/lighting/display/metering.h"
#include "modules/lighting/display/tone_reference.h"
#include "modules/lighting/kept_light.h"
#include "modules/lighting/knobs.h"
#include "modules/lighting/lighting_passes.h"
#include "modules/lighting/occlusion.h"
#include "modules/lighting/occlusion_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lit_tiles_shared.h"

namespace gloam {
namespace {

class LightingModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "lighting"; }
  [[nodiscard]] std::vector<std::string_view> follows() const override { return {"lights", "shadows", "closeups"}; }

  void register_components(World& world) const override { world.ensure_resource<FlameSource>(); }
  void scene_keys(KeyRegistry&) const override {}

  void knobs(KnobRegistry& registry) const override {
    add_knobs(registry, name(), kToneMap, kToneMapTable, kDither, kSpecularAntialiasing, kAntialiasing, kExposure,
              kAmbientOcclusion, kLightReuse);
  }

  [[nodiscard]] std::vector<ReferenceInfo> references() const override {
    std::vector<ReferenceInfo> list;
    list.push_back({.knob = std::string(kToneMapTable.name),
                    .kind = "double precision",
                    .name = "tone curve on the CPU",
                    .follows_value = true,
                    .draw = &draw_tone_reference});
    list.push_back(supersampled_reference(std::string(kAntialiasing.name)));
    list.push_back(supersampled_reference(std::string(kSpecularAntialiasing.name)));
    return list;
  }

  void prepare_world(World& world, const KnobRegistry& registry) const override { choose_exposure(world, registry); }
  void prepare_view(World& world, ViewId view, const KnobRegistry& registry) const override {
    // Tokuyoshi and Kaplanyan: twice the variance 1 / 2π of a Gaussian of a pixel.
    constexpr float kPixelVariance = 0.32f;
    const bool filters = registry.value(kSpecularAntialiasing) && world.try_resource<PointSampledFrame>() == nullptr;
    const float variance = filters ? kPixelVariance : 0.0f;
    world.set_view_resource(view, HighlightFilter{variance});
  }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return occlusion_visualizers(); }
  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "every picture is lit"}; }

  [[nodiscard]] bool needs_motion(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kAntialiasing) == Antialiasing::taa;
  }
  [[nodiscard]] bool wants_jitter(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kAntialiasing) == Antialiasing::taa;
  }

  [[nodiscard]] bool changes_at_rest(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kExposure) == ExposureMode::adapting;
  }
  [[nodiscard]] bool computes_every_frame(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kLightReuse) == LightReuseKind::off;
  }
  [[nodiscard]] std::uint32_t frames_to_rest(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kAntialiasing) == Antialiasing::taa ? kAccumulatedFrames : 0;
  }

  [[nodiscard]] bool essential() const override { return true; }

  /// While these are made, frames keep the last knobs, so that changing a knob of shadows never shows a frame without
  /// them.
  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo&, PipelineList& list) const override {
    if (!last_) return;
    const ShadowsOutputs shadows = with_knobs(last_->shadows, knobs);
    ShadingInputs inputs = last_->inputs;
    inputs.plain_highlights = plain_highlights(knobs);
    inputs.occlusion = inputs.occlusion && knobs.value(kAmbientOcclusion);
    list_deferred_pipelines(inputs, shadows, list);
    list_forward_pipelines(inputs, shadows, last_->blended, list);
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::shading) keep_inputs(frame);
    if (phase == PassPhase::shading) {
      add_occlusion_passes(frame);
      add_deferred_pass(frame, reuse_);
      add_blended_layer_passes(frame);
    }
    if (phase == PassPhase::translucent) {
      add_forward_pass(frame);
      add_front_depth_passes(frame);
    }
    if (phase == PassPhase::output) add_tone_map_passes(frame);
    if (phase == PassPhase::visualize) add_occlusion_view_pass(frame);
  }

  void take_result(World& world, ViewId view, std::string_view name, const FrameResult& result) const override {
    take_metered_exposure(world, view, name, result);
    if (name != kLitTilesResult) return;
    reuse_.note_result(world_id(world), view, result.value<shaders::LitTileCommands>());
  }
  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    count_exposure(world, view, sink);
  }
  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    count_metered_exposure(name, result, sink);
    if (name != kLitTilesResult) return;
    const uvec4 counts = result.value<shaders::LitTileCommands>().counts;
    sink.count("lighting.tiles_kept", counts.x - counts.y);
  }
  void release_view(ViewId view) override { reuse_.release_view(view); }
  void release() override {
    last_.reset();
    reuse_.release();
  }

 private:
  void keep_inputs(FrameBuilder& frame) {
    last_.reset();
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    if (shadows == nullptr) return;
    last_ = LastInputs{shading_inputs(frame), *shadows, {}};
    for (const Draw& draw : frame.draws().blended)
      if (last_->blended.empty() || last_->blended.back() != draw.variant) last_->blended.push_back(draw.variant);
  }

  /// Of the last declared view with shadows. They select the pipelines that other knobs would need.
  struct LastInputs {
    ShadingInputs inputs;
    ShadowsOutputs shadows;
    std::vector<SurfaceVariant> blended;
  };
  std::optional<LastInputs> last_;
  mutable LightReuse reuse_;  ///< results come to const modules
};

}  // namespace

std::unique_ptr<Module> make_lighting_module() { return std::make_unique<LightingModule>(); }

}  // namespace gloam
