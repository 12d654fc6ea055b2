// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "veil_module.h"

#include "engine/ecs/view.h"
#include "engine/render/frame_builder.h"
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
    list.push_back(pipeline());
  }

  [[nodiscard]] Status add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::post) return {};
    // Everything that can fail comes before the pass is declared.
    auto made = frame.services().pipelines.get(pipeline());
    if (!made.ok()) return made.error();
    auto nearest = frame.nearest_sampler();
    if (!nearest.ok()) return nearest.error();

    const Veil& veil = *find(frame.world());
    const shaders::VeilConstants constants{veil.radiance, veil.density};
    const ImageRef depth = frame.get<GeometryOutputs>().depth;
    LitOutput& lit = frame.get<LitOutput>();
    PassBuilder pass = frame.graph().add_pass("veil", "veil");
    pass.read(depth, gpu::Access::fragment_read);
    // A write gives a new version of the handle. It goes back to the board: later passes must not name the old one.
    lit.color = pass.write(lit.color, gpu::Access::color_target);
    // Runs later, when the frame is recorded: capture values and the builder, no references to locals.
    pass.execute(
        [&frame, depth, constants, color = lit.color, pipeline = *made, nearest = *nearest](PassContext& context) {
          FullscreenPass draw;
          draw.pipeline = pipeline;
          draw.bindings = {frame.view_binding(), {1, gpu::Binding::Sampled{{.image = context.image(depth)}, nearest}}};
          draw.target = context.image(color);
          draw.width = frame.view().width;
          draw.height = frame.view().height;
          draw.load = gpu::LoadOp::load;  // blended over the light
          draw.constants = std::as_bytes(std::span(&constants, 1));
          record_fullscreen(context.commands(), draw);
        });
    return {};
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

  // One function makes the description, so that list and use agree. A name holds every constant, format and state that
  // varies.
  [[nodiscard]] static gpu::GraphicsPipelineDesc pipeline() {
    gpu::GraphicsPipelineDesc desc =
        fullscreen_pipeline("veil", "veil", shaders::veil::veil_frag, gpu::Format::rgba16_float);
    desc.blend = gpu::BlendMode::premultiplied;
    return desc;
  }
};

}  // namespace

std::unique_ptr<gloam::Module> make_veil_module() { return std::make_unique<VeilModule>(); }

}  // namespace host
