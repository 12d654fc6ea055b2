// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/gathers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/frame_builder.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/sandbox/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFirstShadowBinding = 6;

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

struct Footprints {
  ImageRef search_and_fine;
  ImageRef coarse;
};

void begin(gpu::CommandList& commands, const RenderView& view, std::vector<gpu::ColorTarget> targets) {
  gpu::RenderingDesc rendering;
  rendering.colors = std::move(targets);
  rendering.width = view.width;
  rendering.height = view.height;
  commands.begin_rendering(rendering);
  commands.set_viewport(0.0f, 0.0f, static_cast<float>(view.width), static_cast<float>(view.height));
  commands.set_scissor(0, 0, view.width, view.height);
}

Result<Footprints> add_footprints_pass(FrameBuilder& frame, std::uint32_t light, const ShadowsOutputs& shadows) {
  gpu::GraphicsPipelineDesc desc =
      fullscreen_pipeline("shadow_footprints/" + shadows.variant, "bench", shaders::sandbox::shadow_footprints_frag,
                          gpu::Format::rgba32_float);
  desc.color_formats.push_back(gpu::Format::rgba32_float);
  desc.constants = shadows.constants;
  auto pipeline = frame.services().pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  const LightsOutputs lights = frame.get<LightsOutputs>();
  Footprints footprints{create_view_image(frame, "shadow_footprints", "bench", gpu::Format::rgba32_float),
                        create_view_image(frame, "shadow_footprints_coarse", "bench", gpu::Format::rgba32_float)};
  PassBuilder pass = frame.graph().add_pass("shadow_footprints", "bench");
  for (const ImageRef image : {geometry.depth, geometry.normals, geometry.base_color, lights.texels})
    pass.read(image, gpu::Access::fragment_read);
  declare_shadow_reads(pass, shadows, gpu::Access::fragment_read);
  footprints.search_and_fine = pass.write(footprints.search_and_fine, gpu::Access::color_target);
  footprints.coarse = pass.write(footprints.coarse, gpu::Access::color_target);
  pass.execute([&frame, geometry, lights, footprints, light, shadows, pipeline = *pipeline](PassContext& context) {
    const auto sampled = [&](ImageRef ref) {
      return gpu::Binding::Sampled{{.image = context.image(ref)}, shadows.nearest};
    };
    std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                          {1, lights.lights},
                                          {2, sampled(geometry.depth)},
                                          {3, sampled(geometry.normals)},
                                          {4, sampled(geometry.base_color)},
                                          {5, sampled(lights.texels)}};
    append_shadow_bindings(bindings, kFirstShadowBinding, context, shadows);
    gpu::CommandList& commands = context.commands();
    begin(commands, frame.view(),
          {{.view = {.image = context.image(footprints.search_and_fine)}},
           {.view = {.image = context.image(footprints.coarse)}}});
    commands.bind_pipeline(pipeline);
    commands.bind(bindings);
    commands.push(light);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
  });
  return footprints;
}

Status add_gathers_pass(FrameBuilder& frame, const Footprints& footprints, const ShadowsOutputs& shadows) {
  auto pipeline = frame.services().pipelines.get(
      fullscreen_pipeline("shadow_gathers", "bench", shaders::sandbox::shadow_gathers_frag, gpu::Format::r32_float));
  if (!pipeline.ok()) return pipeline.error();
  ImageRef sum = create_view_image(frame, "shadow_gathers", "bench", gpu::Format::r32_float);
  PassBuilder pass = frame.graph().add_pass("shadow_gathers", "bench");
  for (const ImageRef image : {footprints.search_and_fine, footprints.coarse, shadows.atlas})
    pass.read(image, gpu::Access::fragment_read);
  sum = pass.write(sum, gpu::Access::color_target);
  frame.expose(sum);  // benches hash it
  pass.keep();
  pass.execute([&frame, footprints, sum, shadows, pipeline = *pipeline](PassContext& context) {
    const auto sampled = [&](ImageRef ref) {
      return gpu::Binding::Sampled{{.image = context.image(ref)}, shadows.nearest};
    };
    FullscreenPass draw;
    draw.pipeline = pipeline;
    draw.bindings = {
        {0, sampled(footprints.search_and_fine)}, {1, sampled(footprints.coarse)}, {2, sampled(shadows.atlas)}};
    draw.target = context.image(sum);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    record_fullscreen(context.commands(), draw);
  });
  return {};
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
  [[nodiscard]] Status add_passes(FrameBuilder& frame, PassPhase phase) override {
    if (phase != PassPhase::visualize) return {};
    const auto light = light_index(frame);
    const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
    if (!light || shadows == nullptr) return {};
    const auto footprints = add_footprints_pass(frame, *light, *shadows);
    if (!footprints) return footprints.error();
    return add_gathers_pass(frame, *footprints, *shadows);
  }
};

}  // namespace

std::unique_ptr<Module> make_shadow_gathers_module() { return std::make_unique<ShadowGathersModule>(); }

}  // namespace gloam
