// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "veil_module.h"

#include "engine/ecs/view.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/scene/key_table.h"
#include "shaders/veil/shaders.h"
#include "shaders/veil/veil_shared.h"

namespace host {
namespace {

using namespace gloam;

class VeilModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "veil"; }

  void register_components(World& world) const override { world.register_component<Veil>("veil"); }

  void scene_keys(KeyRegistry& registry) const override {
    registry.add(number_key(key_line("veil", KeyElement::node, "gloam.veil.density", "0", "1/m", "mist"), 0, 10,
                            &Veil::density));
  }

  // Without a view: whether any view may need it. This module's answer is the same for all views.
  [[nodiscard]] Demand demand(const World& world, const RenderView*) const override {
    const Veil* veil = find(world);
    return veil != nullptr && veil->density > 0.0f ? Demand{true, "the scene has a veil"} : Demand{false, "no veil"};
  }

  // What add_passes will ask for: made in the background under Readiness::background.
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    const gpu::Format light[] = {gpu::Format::rgba16_float};
    list.push_back(pipeline_desc(program(), name(), light));
  }

  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::post) return;
    const Veil& veil = *find(frame.world());
    DrawPass pass(frame, "veil", program());
    pass.read("depth_image", frame.get<GeometryOutputs>().depth);
    pass.push(shaders::VeilConstants{veil.radiance, veil.density});
    // A write gives a new version of the handle. It goes back to the board: later passes must not name the old one.
    LitOutput& lit = frame.get<LitOutput>();
    lit.color = pass.target(lit.color, gpu::LoadOp::load);  // blended over the light
    pass.draw_triangle();
  }

  void counters(const World& world, const RenderView&, CounterSink& sink) const override {
    sink.count("veil.density", static_cast<double>(find(world)->density));
  }

 private:
  [[nodiscard]] static const Veil* find(const World& world) {
    const Veil* found = nullptr;
    world.view<const Veil>().each([&](const Veil& veil) { found = &veil; });
    return found;
  }

  // One function describes the pipeline, so that list and use agree.
  [[nodiscard]] static DrawProgram program() {
    return {.fragment = shaders::veil::veil_frag, .blend = gpu::BlendMode::premultiplied};
  }
};

}  // namespace

std::unique_ptr<gloam::Module> make_veil_module() { return std::make_unique<VeilModule>(); }

}  // namespace host
