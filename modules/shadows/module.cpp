// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/module.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/once_log.h"
#include "engine/render/frame_builder.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/units.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "modules/shadows/debug/enclosed_lights.h"
#include "modules/shadows/debug/final_list_views.h"
#include "modules/shadows/debug/idle_knobs.h"
#include "modules/shadows/debug/measures.h"
#include "modules/shadows/debug/pick.h"
#include "modules/shadows/debug/reference_visualizers.h"
#include "modules/shadows/debug/unculled_view.h"
#include "modules/shadows/debug/visualizers.h"
#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/final_lists/buffers.h"
#include "modules/shadows/final_lists/generate.h"
#include "modules/shadows/final_lists/reuse.h"
#include "modules/shadows/keys.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/draw_passes.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/maps/tools.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/reference/adapter.h"
#include "modules/shadows/shadow_passes.h"
#include "modules/shadows/systems.h"

namespace gloam {
namespace {

class ShadowsModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "shadows"; }
  [[nodiscard]] std::vector<std::string_view> needs() const override { return {"lights"}; }

  void register_components(World& world) const override {
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<CasterVolume>("caster_volume");
    world.ensure_resource<CapturePlaces>();
    world.ensure_resource<ShadowTexelGrid>();
    world.ensure_resource<Cookies>();
  }
  void scene_keys(KeyRegistry& registry) const override { add_shadow_keys(registry); }
  void knobs(KnobRegistry& registry) const override { add_shadow_knobs(registry); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return shadow_references(); }
  [[nodiscard]] std::vector<MeasureInfo> measures() const override { return shadow_measures(); }
  [[nodiscard]] std::string idle_knob(const World& world, const RenderView&, std::string_view knob,
                                      const FrameCounters& counters) const override {
    return idle_shadow_knob(world, knob, counters);
  }
  void add_systems(Schedule& schedule) override { add_shadow_systems(schedule); }

  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] std::string switched_off(const World& world, const KnobRegistry& knobs) const override {
    return knobs.value(kShadowMode) == ShadowMode::off && count_cookie_lights(world) == 0 ? "shadows.mode=off" : "";
  }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    return shadow_demand(world, view);
  }

  [[nodiscard]] std::vector<std::string> warnings(const World& world) const override { return enclosed_lights(world); }

  [[nodiscard]] bool needs_casters(const World&, const KnobRegistry& knobs) const override {
    return shadow_knobs(knobs).enabled;
  }

  [[nodiscard]] bool needs_simplified_casters(const World&, const KnobRegistry& knobs) const override {
    return shadow_knobs(knobs).simplified;
  }

  [[nodiscard]] bool needs_caster_levels(const World&, const KnobRegistry& knobs) const override {
    const ShadowKnobs settings = shadow_knobs(knobs);
    return settings.enabled && settings.lod_texels > 0.0f;
  }

  [[nodiscard]] bool needs_smooth_surfaces(const World&, const KnobRegistry& knobs) const override {
    const ShadowKnobs settings = shadow_knobs(knobs);
    return settings.enabled && settings.terminator;
  }

  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override {
    const ShadowKnobs settings = shadow_knobs(knobs);
    if (settings.enabled) list_shadow_map_pipelines(settings, list);
    if (!last_) return;
    const ShadowsOutputs shadows = with_knobs(last_->shadows, knobs);
    if (shadows.final_lists) list_generate_pipelines(settings, shadows, last_->lights, device, list);
  }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    std::vector<VisualizerInfo> views = shadow_visualizers();
    for (VisualizerInfo& view : shadow_reference_visualizers()) views.push_back(std::move(view));
    for (VisualizerInfo& view : final_list_visualizers()) views.push_back(std::move(view));
    for (VisualizerInfo& view : unculled_visualizers()) views.push_back(std::move(view));
    return views;
  }

  void prepare_view(World& world, ViewId view, const KnobRegistry& knobs) const override {
    world.resource<ShadowTexelGrid>().unit = 1.0 / metres_per_unit(world);
    prepare_shadow_view(world, view, shadow_knobs(knobs));
    world.view_resource<ShadowSettings>(view) = shadow_settings(shadow_knobs(knobs));
    auto& view_faces = world.view_resource<ViewFaces>(view);
    view_faces.knobs_version = knobs.version();
    if (view_faces.shrinks != shrinks_) view_faces.side = {};
    view_faces.shrinks = shrinks_;
    // Cookies of lights added after the scene was loaded. The error of a bad file stays in Cookies::faults for the log.
    static_cast<void>(load_cookies(world));
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::visualize) {
      add_shadow_reference_view_pass(frame, once_log_);
      add_final_list_view_pass(frame, once_log_);
      add_shadow_view_pass(frame, states_, once_log_);
      add_unculled_view_passes(frame, once_log_);
    }
    if (phase == PassPhase::shading) keep_list_counters(frame);
    if (phase != PassPhase::lists) return;
    warn(frame);
    add_shadow_passes(frame, states_, reuse_);
    if (!frame.status().ok()) return;
    if (const LightsOutputs* lights = frame.find<LightsOutputs>())
      last_ = LastInputs{frame.get<ShadowsOutputs>(), *lights};
    if (const auto& outputs = frame.get<ShadowsOutputs>(); outputs.final_lists) {
      const auto tools =
          std::make_shared<ShadowMapTools>(ShadowMapTools{states_, knobs_of(frame), outputs.block_values});
      frame.put(ShadowMapDrawer(tools));
      frame.put(OverlayMaps(tools));
    }
    take_light_list_view(frame);
  }

  [[nodiscard]] Status add_pick_copies(FrameBuilder& frame, Captures& copies) override {
    return add_shadow_pick_copies(frame, copies);
  }

  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    return shadow_pick_lines(frame, pixel, copies);
  }

  void take_result(World& world, ViewId view, std::string_view name, const FrameResult& result) const override {
    if (name != kShadowListResult) return;
    const auto& note = std::any_cast<const FinalListNote&>(result.note);
    world.set_view_resource(view, final_list_feedback(result.value<shaders::ShadowListCounters>(), note,
                                                      world.try_view_resource<FinalListFeedback>(view)));
  }

  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    if (name == kShadowListResult)
      count_final_lists(result.value<shaders::ShadowListCounters>(), std::any_cast<const FinalListNote&>(result.note),
                        sink);
  }

  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const ViewFaces& view_faces = world.view_resource<ViewFaces>(view.id);
    const ViewMapState* kept = states_.find(world_id(world), view_faces);
    const ShadowCounts counts = kept == nullptr ? ShadowCounts{} : kept->counts;
    const auto texels = static_cast<double>(view_faces.atlas.size()) * view_faces.atlas.size();
    sink.count("shadows.casting_lights", view_faces.casting_lights);
    sink.count("shadows.faces_drawn", counts.drawn);
    sink.count("shadows.faces_cached", counts.cached);
    sink.count("shadows.faces_in_turn", counts.in_turn);
    sink.count("shadows.faces_skipped", counts.skipped);
    sink.count("shadows.texels_drawn", static_cast<double>(counts.texels));
    sink.count("shadows.triangles_drawn", static_cast<double>(counts.triangles));
    sink.count("shadows.faces_shrunk", view_faces.faces_shrunk);
    sink.count("shadows.faces_at_limit", view_faces.faces_at_limit);
    sink.count("shadows.faces_left_out", view_faces.faces_left_out);
    sink.count("shadows.faces_waiting", view_faces.faces_waiting);
    sink.count("shadows.views_in_turns", static_cast<double>(states_.views_in_turns()));
    sink.count("shadows.atlas_used", static_cast<double>(view_faces.atlas.used_texels()) / std::max(texels, 1.0));
  }

  [[nodiscard]] bool computes_every_frame(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kShadowReuse) == ShadowReuse::off;
  }
  [[nodiscard]] bool spreads_work(const World& world, const RenderView& view) const override {
    const auto* view_faces = world.try_view_resource<ViewFaces>(view.id);
    return view_faces != nullptr && view_faces->faces_waiting > 0;
  }

  void release_view(ViewId view) override {
    states_.release_view(view);
    states_.free_idle_memory();  // what all views share may be larger than the others need
    reuse_.release_view(view);
  }
  void free_idle_memory() override {
    states_.free_idle_memory();
    ++shrinks_;
  }
  void give_up_frame(std::uint64_t) override {}  // what the module notes about maps changes in commits only
  void release() override {
    states_.release();
    reuse_.release();
    last_.reset();
  }

 private:
  /// Called in PassPhase::shading, because later modules may take slots after PassPhase::lists.
  static void keep_list_counters(FrameBuilder& frame) {
    const auto* note = frame.find<FinalListNote>();
    if (note != nullptr)
      frame.keep_result("shadows", kShadowListResult, frame.get<ShadowsOutputs>().final_lists->counters, *note);
  }
  void warn(FrameBuilder& frame) {
    if (frame.view().is_companion()) return;  // nobody asked for its picture
    const ViewFaces& view_faces = frame.world().view_resource<ViewFaces>(frame.view().id);
    LogSink& log = frame.log();
    if (view_faces.faces_shrunk > 0)
      once_log_.warning(log,
                        "shadow maps are smaller than they should be: the atlas is full (shadows.atlas, counter "
                        "shadows.faces_shrunk)");
    if (view_faces.faces_left_out > 0)
      once_log_.warning(
          log, "some lights cast no shadow: the atlas is full (shadows.atlas, counter shadows.faces_left_out)");
    if (states_.views_in_turns() > 1)  // one alone keeps its maps
      once_log_.warning(log,
                        "some views draw their shadow maps anew in each frame: the maps of all views take more memory "
                        "than shadows.kept_atlases (counter shadows.views_in_turns)");
    for (const std::string& fault : frame.world().resource<Cookies>().faults) once_log_.warning(log, fault);
  }

  /// Of the last declared view. They select the pipelines that other knobs would need.
  struct LastInputs {
    ShadowsOutputs shadows;
    LightsOutputs lights;
  };

  ShadowStates states_;
  ListReuse reuse_;
  std::uint64_t shrinks_ = 0;  ///< calls of free_idle_memory() so far
  std::optional<LastInputs> last_;
  OnceLog once_log_;
};

}  // namespace

std::unique_ptr<Module> make_shadows_module() { return std::make_unique<ShadowsModule>(); }

}  // namespace gloam
