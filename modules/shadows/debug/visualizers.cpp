// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/visualizers.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
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

/// The light's kind (GLOAM_SHADOWS_SPOTS, …), so that the shader can be compiled for it alone.
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

Status add_visibility_view(FrameBuilder& frame, const shaders::ShownLightConstants& light,
                           const ShadowsOutputs& shadows) {
  TargetOutput& target = frame.get<TargetOutput>();
  auto pipeline = frame.services().pipelines.get(visibility_pipeline(shadows, target.format, kind_of(frame, light)));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  const LightsOutputs lights = frame.get<LightsOutputs>();
  const ImageRef texels = lights.texels ? lights.texels : geometry.base_color;  // not read for directional lights
  PassBuilder pass = frame.graph().add_pass("shadow_view", "shadows");
  for (const ImageRef image : {geometry.depth, geometry.normals, geometry.base_color, texels})
    pass.read(image, gpu::Access::fragment_read);
  declare_shadow_reads(pass, shadows, gpu::Access::fragment_read);
  if (shadows.final_lists) declare_final_list_reads(pass, *shadows.final_lists, gpu::Access::fragment_read);
  VisualizerTargets targets =
      write_visualizer_targets(frame, pass, "shadow_visibility", "shadows", gpu::Format::r32_float);
  targets.load_picture = gpu::LoadOp::clear;
  frame.expose(targets.values);
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
    record_visualizer(context, frame.view(), targets, pipeline, bindings, std::as_bytes(std::span(&light, 1)));
  });
  return {};
}

/// The square of each placed face in the picture; the atlas fills the picture's shorter side.
std::vector<shaders::AtlasFaceConstants> atlas_squares(const ShadowViews& views, const RenderView& view,
                                                       const ViewShadows& kept) {
  std::vector<shaders::AtlasFaceConstants> squares;
  const auto side = static_cast<float>(std::min(view.width, view.height));
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
  auto squares = atlas_squares(frame.world().view_resource<ShadowViews>(frame.view().id), frame.view(), kept);
  PassBuilder pass = frame.graph().add_pass("shadow_atlas_view", "shadows");
  pass.read(shadows.atlas, gpu::Access::fragment_read);
  target.color = pass.write(target.color, gpu::Access::color_target);
  const VisualizerTargets targets{target.color, {}, gpu::LoadOp::clear};
  pass.execute([&frame, targets, shadows, squares = std::move(squares), pipeline = *pipeline](PassContext& context) {
    begin_visualizer(context, frame.view(), targets);
    gpu::CommandList& commands = context.commands();
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
       "visibility of the light at each pixel: black unlit, white fully lit, blue out of the light's reach. With "
       "shadows.mode=deferred, read from the tile's final list: surfaces that face away from the light are black too, "
       "unless the whole tile is lit"},
      {"shadow_atlas", "shadows", "",
       "the shadow maps at their places in the atlas: white near the light, dark far from it, blue no caster; border: "
       "orange drawn in this frame, green kept from an earlier frame"}};
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
