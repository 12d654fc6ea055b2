// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/module.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/keys/table.h"
#include "modules/glare/components.h"
#include "modules/glare/glare_passes.h"
#include "modules/glare/knobs.h"
#include "modules/glare/reference/glare_reference.h"
#include "modules/glare/view_glare.h"
#include "modules/lighting/outputs.h"

namespace gloam {
namespace {

constexpr const char* kReferenceView = "glare_reference";

Demand glare_of_view(const World& world, const RenderView& view) {
  if (view.purpose == ViewPurpose::capture) return {false, "captures have no lens"};
  if (view.is_companion()) return {false, "the view's main view has the glare"};
  if (glare_share(world, view) == 0.0f) return {false, "the view's camera has no glare"};
  return {true, "the view's camera has glare"};
}

class GlareModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "glare"; }
  [[nodiscard]] std::vector<std::string_view> follows() const override {
    return {"lights", "shadows", "closeups", "lighting", "reflections", "grass", "particles", "fog", "depth_of_field"};
  }
  void register_components(World& world) const override { world.register_component<Glare>("glare"); }
  void scene_keys(KeyRegistry& registry) const override {
    constexpr double kPercent = 0.01;
    registry.add(number_key(key_line("glare", KeyElement::camera_node, "gloam.camera.glare", "2", "%",
                                     "share of the light that the camera's lens scatters; 0: none"),
                            0, 20, &Glare::share, kPercent));
    registry.add_finish("glare", [](World& world) -> Status {
      add_default_glare(world);
      return {};
    });
  }
  void knobs(KnobRegistry& registry) const override { add_knobs(registry, name(), kGlareLines); }
  [[nodiscard]] std::vector<ReferenceInfo> references() const override { return {glare_reference()}; }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    VisualizerInfo view{.name = kReferenceView,
                        .module = "glare",
                        .legend = "the picture with glare convolved over the whole picture in double precision"};
    view.trace = &put_glare_picture;
    return {std::move(view)};
  }
  [[nodiscard]] std::string switched_off(const World&, const KnobRegistry& knobs) const override {
    return knobs.value(kGlareLines) == 0 ? assignment_of(kGlareLines, 0) : "";
  }
  [[nodiscard]] bool shows_surfaces(const World&, const RenderView&) const override { return false; }
  [[nodiscard]] Demand demand(const World& world, const RenderView* view) const override {
    if (view != nullptr) return glare_of_view(world, *view);
    const auto* usual = world.try_resource<DefaultGlare>();
    if (usual != nullptr && counted_glare(usual->share) > 0.0f) return {true, "cameras have glare by default"};
    std::size_t cameras = 0;
    world.view<const Glare>().each([&](const Glare& glare) { cameras += counted_glare(glare.share) > 0.0f ? 1 : 0; });
    if (cameras == 0) return {false, "no camera has glare"};
    return {true, std::to_string(cameras) + (cameras == 1 ? " camera has glare" : " cameras have glare")};
  }
  void pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const override {
    list_glare_pipelines(list);
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase == PassPhase::announce && frame.visualizer() == kReferenceView) frame.put(VisualizerIsPicture{});
    if (phase == PassPhase::post) add_post_passes(frame);
    if (phase == PassPhase::visualize && frame.find<ScatteredLight>() != nullptr &&
        frame.world().try_resource<ShownLight>() != nullptr)
      add_shown_light_pass(frame);
  }
  void counters(const World& world, const RenderView& view, CounterSink& sink) const override {
    sink.count("glare.percent", 100.0 * static_cast<double>(glare_share(world, view)));
  }
  void free_idle_memory() override { staging_.release(); }
  void release() override { staging_.release(); }

 private:
  void add_post_passes(FrameBuilder& frame) {
    const float share = glare_share(frame.world(), frame.view());
    const GlarePicture* picture = find_glare_picture(frame.world(), frame.view());
    if (picture == nullptr) return add_glare_passes(frame, share, frame.knobs().value(kGlareLines));
    ScatteredLight scattered;
    scattered.light = upload_light_picture(frame, staging_, "glare_picture", *picture);
    scattered.uv_scale = 1.0f / vec2(picture->width, picture->height);
    scattered.share = share;
    if (scattered.light) frame.put(scattered);
  }

  Staging staging_{"glare"};
};

}  // namespace

std::unique_ptr<Module> make_glare_module() { return std::make_unique<GlareModule>(); }

}  // namespace gloam
