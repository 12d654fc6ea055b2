// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/gathers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/declare/draw_pass.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

std::optional<std::uint32_t> light_index(const FrameBuilder& frame) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = kShadowGathersView;
  if (!shown.starts_with(stem) || shown.size() <= stem.size() + 1) return std::nullopt;
  const auto entity = frame.world().resource<SceneNames>().find("light", shown.substr(stem.size() + 1));
  if (!entity.ok()) return std::nullopt;
  const auto lights = local_lights(frame.world().view_resource<VisibleLights>(frame.view().id));
  const auto at = std::find(lights.begin(), lights.end(), *entity);
  if (at == lights.end()) return std::nullopt;
  return static_cast<std::uint32_t>(at - lights.begin());
}

void add_gathers_passes(FrameBuilder& frame, std::uint32_t light, const ShadowsOutputs& shadows) {
  DrawPass find(frame, "shadow_footprints", {shaders::sandbox::shadow_footprints_frag, shadows.constants});
  read_geometry(find, frame.get<GeometryOutputs>());
  read_light_lists(find, frame.get<LightsOutputs>());
  read_shadows(find, shadows);
  find.push(light);
  const auto footprints = [&](const char* name) {
    return find.target(create_view_image(frame, name, gpu::Format::rgba32_float), gpu::LoadOp::clear);
  };
  const ImageRef search_and_fine = footprints("shadow_footprints");
  const ImageRef coarse = footprints("shadow_footprints_coarse");
  find.draw_triangle();

  DrawPass gather(frame, "shadow_gathers", {shaders::sandbox::shadow_gathers_frag});
  gather.read("search_and_fine_image", search_and_fine);
  gather.read("coarse_image", coarse);
  gather.read("atlas", shadows.atlas);
  frame.expose(gather.target(create_view_image(frame, "shadow_gathers", gpu::Format::r32_float)));  // benches hash it
  gather.keep();
  gather.draw_triangle();
}

class ShadowGathersModule final : public Module {
 public:
  [[nodiscard]] std::string_view name() const override { return "bench"; }
  void register_components(World&) const override {}
  void scene_keys(KeyRegistry&) const override {}
  [[nodiscard]] Demand demand(const World&, const RenderView*) const override { return {true, "benches"}; }
  [[nodiscard]] std::vector<VisualizerInfo> visualizers() const override {
    return {{kShadowGathersView, "bench", "LIGHT", "the picture as it is; its passes are timed"}};
  }
  void add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::visualize) return;
    const auto light = light_index(frame);
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    if (light && shadows != nullptr) add_gathers_passes(frame, *light, *shadows);
  }
};

}  // namespace

std::unique_ptr<Module> make_shadow_gathers_module() { return std::make_unique<ShadowGathersModule>(); }

}  // namespace gloam
