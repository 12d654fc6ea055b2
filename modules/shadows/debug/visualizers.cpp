// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/visualizers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/maps/map_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFirstShadowBinding = 6;
constexpr std::uint32_t kFirstFinalListBinding = 12;

/// GLOAM_SHADOWS_…: what the shader may leave out of account.
std::uint32_t kind_of(const FrameBuilder& frame, const shaders::ShownLightConstants& light) {
  if (light.directional != 0) return GLOAM_SHADOWS_SUNS;
  const auto& rows = frame.world().view_resource<ShadowViews>(frame.view().id).rows;
  const float kind = light.light < rows.size() ? rows[light.light].kind : static_cast<float>(GLOAM_SHADOW_NONE);
  return kind == static_cast<float>(GLOAM_SHADOW_CUBE) ? GLOAM_SHADOWS_CUBES : GLOAM_SHADOWS_SPOTS;
}

gpu::GraphicsPipelineDesc visibility_pipeline(const ShadowsOutputs& shadows, gpu::Format format, std::uint32_t kind) {
  const FinalLists* lists = shadows.final_lists ? &*shadows.final_lists : nullptr;
  const bool fallback = lists != nullptr && !lists->always_complete;
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline(
      "shadow_visibility_view/" + std::to_string(kind) + "/" + std::string(gpu::name_of(format)) + "/" +
          shadows.variant + (lists == nullptr ? "" : "/" + lists->variant + (fallback ? "/fallback" : "")),
      "shadows",
      lists == nullptr ? shaders::shadows::visibility_view_frag : shaders::shadows::final_visibility_view_frag, format);
  desc.color_formats.push_back(gpu::Format::r32_float);
  desc.constants = shadows.constants;
  if (lists != nullptr) {
    desc.constants.insert(desc.constants.end(), lists->constants.begin(), lists->constants.end());
    desc.constants.push_back({1, fallback ? 1u : 0u});
  }
  desc.constants.push_back({0, gpu::encodes_srgb(format) ? 0u : 1u});
  desc.constants.push_back({GLOAM_SHADOWS_KINDS_ID, kind});
  return desc;
}

/// What a view pass draws over.
struct ViewTargets {
  ImageRef picture;
  ImageRef named;  ///< none: the picture alone
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

void begin(gpu::CommandList& commands, PassContext& context, const RenderView& view, const ViewTargets& targets) {
  gpu::RenderingDesc rendering;
  rendering.colors.push_back({.view = {.image = context.image(targets.picture)}, .load = gpu::LoadOp::clear});
  if (targets.named)
    rendering.colors.push_back({.view = {.image = context.image(targets.named)}, .load = gpu::LoadOp::clear});
  begin_view_rendering(commands, view, std::move(rendering));
}

Status add_visibility_view(FrameBuilder& frame, const shaders::ShownLightConstants& light,
                           const ShadowsOutputs& shadows) {
  TargetOutput& target = frame.get<TargetOutput>();
  auto pipeline = frame.services().pipelines.get(visibility_pipeline(shadows, target.format, kind_of(frame, light)));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  const LightsOutputs lights = frame.get<LightsOutputs>();
  const ImageRef texels = lights.texels ? lights.texels : geometry.base_color;  // not looked at for directional lights
  ViewTargets targets{{},
                      create_view_image(frame, "shadow_visibility", "shadows", gpu::Format::r32_float),
                      frame.view().width,
                      frame.view().height};
  PassBuilder pass = frame.graph().add_pass("shadow_view", "shadows");
  for (const ImageRef image : {geometry.depth, geometry.normals, geometry.base_color, texels})
    pass.read(image, gpu::Access::fragment_read);
  declare_shadow_reads(pass, shadows, gpu::Access::fragment_read);
  if (shadows.final_lists) declare_final_list_reads(pass, *shadows.final_lists, gpu::Access::fragment_read);
  targets.named = pass.write(targets.named, gpu::Access::color_target);
  target.color = targets.picture = pass.write(target.color, gpu::Access::color_target);
  frame.expose(targets.named);
  pass.execute([&frame, geometry, lights, texels, targets, light, shadows, pipeline = *pipeline,
                sampler = *sampler](PassContext& context) {
    const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, sampler}; };
    std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                          {1, lights.lights},
                                          {2, sampled(geometry.depth)},
                                          {3, sampled(geometry.normals)},
                                          {4, sampled(geometry.base_color)},
                                          {5, sampled(texels)}};
    append_shadow_bindings(bindings, kFirstShadowBinding, context, shadows);
    if (shadows.final_lists)
      append_final_list_bindings(bindings, kFirstFinalListBinding, context, *shadows.final_lists, sampler);
    gpu::CommandList& commands = context.commands();
    begin(commands, context, frame.view(), targets);
    commands.bind_pipeline(pipeline);
    commands.bind(bindings);
    commands.push(light);
    commands.draw(3, 1, 0, 0);
    commands.end_rendering();
  });
  return {};
}

/// Each face where it lies in the atlas, which fills the picture's height or width.
std::vector<shaders::AtlasFaceConstants> atlas_squares(const ShadowViews& views, const ViewTargets& targets,
                                                       const ViewShadows& kept) {
  std::vector<shaders::AtlasFaceConstants> squares;
  const auto side = static_cast<float>(std::min(targets.width, targets.height));
  const float scale = side / static_cast<float>(std::max(views.atlas.size(), 1u));
  for (const ShadowFace& face : views.faces) {
    if (face.square.size == 0) continue;
    shaders::AtlasFaceConstants square{};
    square.origin = vec2(face.square.origin);
    square.size = static_cast<float>(face.square.size);
    square.near_m = face.tan_half > 0.0f ? face.near_m : 0.0f;
    square.far_m = face.far_m;
    const FaceKey key{face.light, face.index};
    square.drawn = std::find(kept.drawn.begin(), kept.drawn.end(), key) != kept.drawn.end() ? 1.0f : 0.0f;
    square.corner = glm::floor(square.origin * scale);
    square.pixels = std::max(1.0f, std::floor(square.size * scale));
    squares.push_back(square);
  }
  return squares;
}

Status add_atlas_view(FrameBuilder& frame, const ShadowsOutputs& shadows, const ViewShadows& kept) {
  TargetOutput& target = frame.get<TargetOutput>();
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline("shadow_atlas_view/" + std::string(gpu::name_of(target.format)),
                                                       "shadows", shaders::shadows::atlas_view_frag, target.format);
  desc.constants = {{0, gpu::encodes_srgb(target.format) ? 0u : 1u}};
  auto pipeline = frame.services().pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  ViewTargets targets{{}, {}, frame.view().width, frame.view().height};
  auto squares = atlas_squares(frame.world().view_resource<ShadowViews>(frame.view().id), targets, kept);
  PassBuilder pass = frame.graph().add_pass("shadow_atlas_view", "shadows");
  pass.read(shadows.atlas, gpu::Access::fragment_read);
  target.color = targets.picture = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, targets, shadows, squares = std::move(squares), pipeline = *pipeline](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    begin(commands, context, frame.view(), targets);
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {
        {0, gpu::Binding::Sampled{{.image = context.image(shadows.atlas)}, shadows.nearest}}};
    commands.bind(bindings);
    for (const shaders::AtlasFaceConstants& square : squares) {
      const auto pixels = static_cast<std::uint32_t>(square.pixels);
      commands.set_scissor(static_cast<std::int32_t>(square.corner.x), static_cast<std::int32_t>(square.corner.y),
                           pixels, pixels);
      commands.push(square);
      commands.draw(3, 1, 0, 0);
    }
    commands.end_rendering();
  });
  return {};
}

}  // namespace

std::vector<VisualizerInfo> shadow_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"shadow", "shadows", "LIGHT",
       "how much of the light each surface sees: black nothing, white all of it; blue: beyond its reach. With "
       "shadows.mode=deferred as its tile's list says: black too where the light comes from behind, unless the tile is "
       "lit as a whole"},
      {"shadow_atlas", "shadows", "",
       "the view's shadow maps where they lie: white near the light, dark far from it, blue nothing; orange border: "
       "drawn in this frame, "
       "green: kept from an earlier one"}};
  for (VisualizerInfo& view : views) {
    view.knob = "shadows.mode";
    view.value = "monolithic|deferred";
  }
  return views;
}

Status add_shadow_view_pass(FrameBuilder& frame, const ShadowStates& states) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = shown.substr(0, shown.find(':'));
  if (stem != "shadow" && stem != "shadow_atlas") return {};
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  if (shadows == nullptr) return {};
  if (stem == "shadow_atlas") {
    const ViewShadows* kept = states.find(frame.world().resource<ShadowWorld>(), frame.view().id);
    if (kept == nullptr || shadows->atlas.resource == shadows->rows.resource) return {};
    return add_atlas_view(frame, *shadows, *kept);
  }
  const auto light = shown_light(frame, shown.substr(stem.size() + 1));
  if (!light) {
    frame.services().log.warning("view " + std::string(shown) +
                                 " shows the picture as it is: the light reaches nothing in view");
    return {};
  }
  return add_visibility_view(frame, *light, *shadows);
}

}  // namespace gloam
