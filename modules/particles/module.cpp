// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/module.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/schedule/schedule.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/components.h"
#include "modules/particles/debug/overdraw.h"
#include "modules/particles/debug/pick.h"
#include "modules/particles/emitters/flames.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "modules/particles/emitters/visible.h"
#include "modules/particles/keys.h"
#include "modules/particles/knobs.h"
#include "modules/particles/particle_passes.h"
#include "modules/particles/reference/adapter.h"

namespace gloam {
namespace {

constexpr const char* kDrawsResult = "draws";

class ParticlesModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "particles"; }
  [[nodiscard]] std::vector<std::string_view> needs() const override { return {"lights"}; }
  [[nodiscard]] std::vector<std::string_view> follows() const override { return {"shadows", "closeups", "lighting"}; }
  void register_components(World& world) const override {
    world.register_component<ParticleEmitter>("particle_emitter");
    world.set_resource(particle_flames());
    world.ensure_resource<EmitterSet>();
    world.ensure_resource<EmitterPaths>();
    world.ensure_resource<EmitterLights>();
    world.ensure_resource<ParticleLightMaps>();
  }
  void scene_keys(KeyRegistry& registry) const override { add_particle_keys(registry); }
  void knobs(KnobRegistry& registry) const override { add_particle_knobs(registry); }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    std::size_t emitters = 0;
    world.view<const ParticleEmitter>().each([&](const ParticleEmitter& e) { emitters += emits(e) ? 1 : 0; });
    if (emitters == 0) return {false, "no emitter"};
    if (view == nullptr) return {true, std::to_string(emitters) + (emitters == 1 ? " emitter" : " emitters")};
    if (view->purpose == ViewPurpose::capture) return {false, "captures have no particles"};
    if (view->static_only) return {false, "particles move"};
    const auto* visible = world.try_view_resource<VisibleEmitters>(view->id);
    if (visible == nullptr || visible->emitters.empty()) return {false, "no emitter in view"};
    return {true, std::to_string(visible->emitters.size()) + " of " + std::to_string(emitters) +
                      (emitters == 1 ? " emitter in view" : " emitters in view")};
  }
  [[nodiscard]] bool changes_at_rest(const World&, const KnobRegistry&) const override { return true; }
  void add_systems(Schedule& schedule) override {
    schedule.add_system("particle_emitters", "particles", Stage::world, &particle_emitters_system);
    schedule.add_system("particle_lights", "particles", Stage::world, &particle_lights_system);
    schedule.add_system("particle_view", "particles", Stage::view, &particle_view_system);
  }
  void prepare_view(World& world, ViewId view, const KnobRegistry&) const override {
    if (world.try_view_resource<VisibleEmitters>(view) == nullptr) world.set_view_resource(view, VisibleEmitters{});
  }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return particle_references(); }
  [[nodiscard]] std::string idle_knob(const World&, const RenderView&, std::string_view,
                                      const FrameCounters& counters) const override {
    const auto drawn = counters.find("particles.drawn");
    return drawn != counters.end() && drawn->second == 0.0 ? "no particle is drawn" : "";
  }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override { return particle_visualizers(); }
  void pipelines(const KnobRegistry& knobs, const gpu::DeviceInfo& device, PipelineList& list) const override {
    list_particle_pipelines(particle_lighting(knobs), last_version_, last_jittered_, device.threads_in_turn, list);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::translucent) add_particle_passes(frame);
    const ParticlesFrame* particles = frame.find<ParticlesFrame>();
    if (phase == PassPhase::visualize) add_overdraw_passes(frame, particles);
    if (phase != PassPhase::translucent || particles == nullptr || !frame.status().ok()) return;
    last_version_ = particle_light_version(frame, particles->inputs.atlas);
    last_jittered_ = frame.view().jittered;
    frame.keep_result("particles", kDrawsResult, particles->sorted.draws, particles->inputs.lighting);
  }
  void result_counters(std::string_view name, const FrameResult& result, CounterSink& sink) const override {
    if (name != kDrawsResult) return;
    const auto drawn = static_cast<double>(result.value<shaders::ParticleDraws>().drawn);
    const auto* lighting = std::any_cast<ParticleLighting>(&result.note);
    sink.count("particles.drawn", drawn);
    sink.count("particles.lit", lighting != nullptr && *lighting == ParticleLighting::off ? 0.0 : drawn);
  }
  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    const EmitterSet& set = world.resource<EmitterSet>();
    const VisibleEmitters& visible = world.view_resource<VisibleEmitters>(view.id);
    sink.count("particles.alive", static_cast<double>(visible.alive));
    sink.count("particles.simulated", static_cast<double>(visible.particles));
    sink.count("particles.left_out", set.left_out);
    sink.count("particles.emitters", static_cast<double>(set.emitters.size()));
    sink.count("particles.emitters_in_view", static_cast<double>(visible.emitters.size()));
    sink.count("particles.emitters_left_out", static_cast<double>(visible.left_out));
    sink.count("particles.emitters_not_finite", set.unusable);
    sink.count("particles.light_maps_outdated", world.resource<EmitterLights>().outdated);
  }
  [[nodiscard]] Status add_pick_copies(FrameBuilder& frame, Captures& copies) override {
    const ParticlesFrame* particles = frame.find<ParticlesFrame>();
    return particles == nullptr ? Status() : add_particle_pick_copies(frame, *particles, copies);
  }
  [[nodiscard]] std::vector<std::string> pick(FrameBuilder& frame, const PickedPixel& pixel,
                                              const Captures& copies) const override {
    if (frame.find<ParticlesFrame>() == nullptr) return {};
    return particle_pick_lines(frame, pixel, copies);
  }
  void give_up_frame(std::uint64_t) override {}  // what it keeps is no state of a frame

 private:
  ParticleLightVersion last_version_;
  bool last_jittered_ = false;
};

}  // namespace

std::unique_ptr<Module> make_particles_module() { return std::make_unique<ParticlesModule>(); }

}  // namespace gloam
