// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "veil_module.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/passes/visualizer_pass.h"
#include "engine/scene/keys/table.h"
#include "engine/scene/resources.h"
#include "engine/schedule/schedule.h"
#include "shaders/veil/shaders.h"
#include "shaders/veil/veil_shared.h"

namespace host {
namespace {

using namespace gloam;

constexpr double kRiseTime_s = 2.0;  // after which 63 % of the mist has risen
constexpr double kMeanTime_s = 0.2;  // over which the captured light is averaged

constexpr IntegerKnob<std::int32_t> kStride{
    .name = "veil.stride",
    .meaning = "distance between the captured texels that the mist's light is the mean of",
    .min = 1,
    .max = 8,
    .default_value = 2,
    .exact = 1,
    .unit = "texels"};

// The share of a change that happens in one frame, so that the change takes the same time at any frame rate.
float share_of_frame(const SceneClock& clock, double time_s) {
  return static_cast<float>(1.0 - std::exp(-std::max(clock.dt_s, 0.0) / time_s));
}

// A system. Its parameters are its access list: it writes Veil and reads the clock.
void rise_system(View<Veil> veils, Resource<const SceneClock> clock) {
  const float share = share_of_frame(*clock, kRiseTime_s);
  veils.each([&](Veil& veil) { veil.risen += share * (veil.density - veil.risen); });
}

class VeilModule final : public Module {
 public:
  explicit VeilModule(gpu::ImageHandle surroundings) : surroundings_(surroundings) {}

  [[nodiscard]] std::string_view name() const override { return "veil"; }

  void register_components(World& world) const override { world.register_component<Veil>("veil"); }

  void scene_keys(KeyRegistry& registry) const override {
    registry.add(number_key(key_line("veil", KeyElement::node, "gloam.veil.density", "0", "1/m", "mist"), 0, 10,
                            &Veil::density));
  }

  void knobs(KnobRegistry& registry) const override { add_knobs(registry, name(), kStride); }

  void add_systems(Schedule& schedule) override {
    schedule.add_system("veil_rise", "veil", Stage::world, &rise_system);
  }

  // Without a view: whether any view may need it. Captures are drawn without mist: it takes its light from them.
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    const Veil* veil = find(world);
    if (veil == nullptr || !(veil->density > 0.0f)) return {false, "no veil"};
    if (view != nullptr && view->purpose == ViewPurpose::capture) return {false, "captures have no veil"};
    return {true, "the scene has a veil"};
  }

  // The mist rises by itself, so a window must go on drawing while nothing else moves.
  [[nodiscard]] bool changes_at_rest(const World&, const KnobRegistry&) const override { return true; }

  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    return {
        {.name = "veil_share", .module = "veil", .legend = "share of the light that is the mist's: black 0, white 1"}};
  }

  // Lists the pipelines of add_passes, so that they are made in the background under Readiness::background.
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    const gpu::Format light[] = {gpu::Format::rgba16_float};
    list.push_back(pipeline_desc(ComputeProgram{shaders::veil::average_comp}, name()));
    list.push_back(pipeline_desc(veil_program(), name(), light));
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::post) add_veil_pass(frame);
    if (phase == PassPhase::visualize && frame.visualizer() == "veil_share") add_share_pass(frame);
  }

  void counters(const World& world, const RenderView&, CounterSink& sink) const override {
    sink.count("veil.density", static_cast<double>(find(world)->risen));
  }

 private:
  void add_veil_pass(FrameBuilder& frame) {
    const ImageRef glow = add_average_pass(frame);
    if (!glow) return;
    DrawPass pass(frame, "veil", veil_program());
    pass.read("depth_image", frame.get<GeometryOutputs>().depth);
    pass.read("glow", glow);
    pass.push(constants_of(frame));
    // A write gives a new version of the handle. It goes back to the board: later passes must not name the old one.
    LitOutput& lit = frame.get<LitOutput>();
    lit.color = pass.target(lit.color, gpu::LoadOp::load);  // blended over the light
    pass.draw_triangle();
  }

  // The mean light of the captured surroundings, averaged over frames in one texel. Null if the frame was given up.
  [[nodiscard]] ImageRef add_average_pass(FrameBuilder& frame) {
    gpu::ImageDesc desc;
    desc.name = "veil_glow";
    desc.module = name();
    desc.format = gpu::Format::rgba16_float;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::storage;
    // Two images that swap roles from frame to frame; a camera cut begins the average anew.
    const auto glow = frame.history_image_pair(desc, {.reset = {.camera_cut = true}});
    if (!frame.check(glow)) return {};
    ComputePass pass(frame, "veil_average", {shaders::veil::average_comp});
    pass.read("surroundings", frame.captured_light(surroundings_, gpu::Access::compute_read));
    pass.read("previous", glow->previous);
    const ImageRef current = pass.write("current", glow->current);
    const float share = share_of_frame(frame.world().resource<SceneClock>(), kMeanTime_s);
    const std::int32_t stride = frame.knobs().value(kStride);
    pass.push(shaders::VeilAverage{glow->valid() ? share : 1.0f, stride});
    pass.dispatch(1);
    return current;
  }

  void add_share_pass(FrameBuilder& frame) {
    DrawPass pass(frame, "veil_share", {shaders::veil::share_frag, visualizer_constants(frame)});
    pass.read("depth_image", frame.get<GeometryOutputs>().depth);
    pass.push(constants_of(frame));
    add_visualizer_targets(frame, pass, "veil_share", gpu::Format::rgba16_float);
    pass.draw_triangle();
  }

  [[nodiscard]] static shaders::VeilConstants constants_of(const FrameBuilder& frame) {
    const Veil& veil = *find(frame.world());
    return {veil.albedo, veil.risen};
  }

  [[nodiscard]] static const Veil* find(const World& world) {
    const Veil* found = nullptr;
    world.view<const Veil>().each([&](const Veil& veil) { found = &veil; });
    return found;
  }

  // One function describes the pipeline, so that list and use agree.
  [[nodiscard]] static DrawProgram veil_program() {
    return {.fragment = shaders::veil::veil_frag, .blend = gpu::BlendMode::premultiplied};
  }

  gpu::ImageHandle surroundings_;
};

}  // namespace

std::unique_ptr<gloam::Module> make_veil_module(gloam::gpu::ImageHandle surroundings) {
  return std::make_unique<VeilModule>(surroundings);
}

}  // namespace host
