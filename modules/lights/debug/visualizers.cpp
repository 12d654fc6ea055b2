// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/visualizers.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"
#include "shaders/lights/shaders.h"

namespace gloam {
namespace {

/// The first four in the order of kCount of light_count_view.frag. `nothing` stands in where there is no list to show.
enum class LightView : std::uint32_t {
  mask_counts,
  approx_counts,
  accurate_counts,
  difference_counts,
  culling,
  list,
  nothing
};

struct NamedView {
  std::string_view name;
  LightView view;
};
constexpr NamedView kViews[] = {
    {"tile_masks", LightView::mask_counts},          {"lights_approx", LightView::approx_counts},
    {"lights_accurate", LightView::accurate_counts}, {"lights_difference", LightView::difference_counts},
    {"light_culling", LightView::culling},           {"light_list", LightView::list},
};

bool shows_one_light(LightView view) { return view == LightView::culling || view == LightView::list; }
bool shows_counts(LightView view) { return view < LightView::culling; }

struct ViewShader {
  std::string_view name;
  gpu::ShaderCode fragment;
};
ViewShader shader_of(LightView view) {
  if (view == LightView::culling) return {"light_culling_view", shaders::lights::light_culling_view_frag};
  if (view == LightView::list) return {"light_list_view", shaders::lights::light_list_view_frag};
  if (view == LightView::nothing) return {"light_nothing_view", shaders::lights::light_nothing_view_frag};
  return {"light_count_view", shaders::lights::light_count_view_frag};
}

gpu::GraphicsPipelineDesc view_pipeline(LightView view, gpu::Format format) {
  const ViewShader shader = shader_of(view);
  const auto count = static_cast<std::uint32_t>(view);
  std::string name = std::string(shader.name) + "/" + std::string(gpu::name_of(format));
  if (shows_counts(view)) name += "/" + std::to_string(count);
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline(std::move(name), "lights", shader.fragment, format);
  desc.color_formats.push_back(gpu::Format::rgba8_unorm);
  desc.blend = gpu::BlendMode::alpha;
  desc.constants = {{0, gpu::encodes_srgb(format) ? 0u : 1u}};
  if (shows_counts(view)) desc.constants.push_back({1, count});
  return desc;
}

/// What a view pass records with.
struct ViewDraw {
  LightView view = LightView::nothing;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
  LightsOutputs lights;
  GeometryOutputs geometry;
  std::uint32_t light = 0;  ///< that is shown, of the sorted ones
  float opacity = 1.0f;     ///< of nothing over the picture
  ImageRef picture;
  ImageRef named;
};

void declare_reads(PassBuilder& pass, const ViewDraw& draw) {
  if (draw.view == LightView::nothing) return;
  pass.read(draw.lights.tile_lists, gpu::Access::fragment_read);
  if (shows_counts(draw.view)) return;
  pass.read(draw.geometry.depth, gpu::Access::fragment_read);
  pass.read(draw.lights.texels, gpu::Access::fragment_read);
  pass.read(draw.lights.group_masks, gpu::Access::fragment_read);
  pass.read(draw.lights.early_lists, gpu::Access::fragment_read);
  if (draw.view == LightView::culling) pass.read(draw.geometry.depth_bounds, gpu::Access::fragment_read);
}

std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context, const ViewDraw& draw) {
  const auto sampled = [&](ImageRef image) {
    return gpu::Binding::Sampled{{.image = context.image(image)}, draw.sampler};
  };
  const auto whole = [&](BufferRef buffer) { return gpu::Binding::BufferRange{context.buffer(buffer)}; };
  const LightsOutputs& lights = draw.lights;
  if (draw.view == LightView::nothing) return {};
  if (shows_counts(draw.view)) return {{0, lights.grid}, {1, lights.mask_tiles}, {2, sampled(lights.tile_lists)}};
  std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                        {1, lights.grid},
                                        {2, sampled(draw.geometry.depth)},
                                        {3, sampled(lights.texels)},
                                        {4, whole(lights.group_masks)},
                                        {5, sampled(lights.tile_lists)},
                                        {6, whole(lights.early_lists)}};
  if (draw.view == LightView::culling) {
    bindings.push_back({7, sampled(draw.geometry.depth_bounds)});
    bindings.push_back({8, lights.z_bins});
    bindings.push_back({9, lights.mask_tiles});
  }
  return bindings;
}

void record(const FrameBuilder& frame, PassContext& context, const ViewDraw& draw) {
  gpu::CommandList& commands = context.commands();
  gpu::RenderingDesc rendering;
  rendering.colors.push_back({.view = {.image = context.image(draw.picture)}, .load = gpu::LoadOp::load});
  rendering.colors.push_back({.view = {.image = context.image(draw.named)}, .load = gpu::LoadOp::clear});
  begin_view_rendering(commands, frame.view(), std::move(rendering));
  commands.bind_pipeline(draw.pipeline);
  commands.bind(bindings_of(frame, context, draw));
  if (shows_one_light(draw.view)) commands.push(draw.light);
  if (draw.view == LightView::nothing) commands.push(draw.opacity);
  commands.draw(3, 1, 0, 0);
  commands.end_rendering();
}

}  // namespace

std::vector<VisualizerInfo> light_visualizers() {
  const std::string heat = ": black 0, blue 6, cyan 12, green 19, yellow 25, red 31, white 32 and more";
  std::vector<VisualizerInfo> views = {
      {"tile_masks", "lights", "", "lights that the CPU finds for each 32x32 tile" + heat},
      {"light_culling", "lights", "LIGHT",
       "tiles where the light passed the CPU's tile mask (grey), the zBins too (blue), the tile group's mask too "
       "(orange), and is in the "
       "tile's list (green); red: it is not, though it reaches a pixel of the tile"},
      {"light_list", "lights", "LIGHT",
       "pixels whose tile's list holds the light: blue, those that it reaches yellow; red: reached, but not in the "
       "list. With shadows.mode=deferred: yellow lit as a whole, green a slot, bright where it is seen, blue left out "
       "as "
       "unlit, magenta shaded from shadow maps"},
      {"lights_approx", "lights", "", "lights of each 8x8 tile after the approximate search" + heat},
      {"lights_accurate", "lights", "", "lights of each 8x8 tile after the accurate search" + heat},
      {"lights_difference", "lights", "", "lights of each 8x8 tile that only the approximate search finds" + heat}};
  for (VisualizerInfo& view : views) {
    view.knob = "lights.culling";
    view.value = "tiled";
  }
  return views;
}

namespace {

/// Whether a later module shows the view of this light.
bool is_taken(const FrameBuilder& frame, LightView view, std::string_view light) {
  if (view != LightView::list || frame.find<LightListViewTaken>() == nullptr) return false;
  const auto entity = frame.world().resource<SceneNames>().find("light", light);
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  const auto holds = [&](const std::vector<Entity>& lights) {
    return std::find(lights.begin(), lights.end(), *entity) != lights.end();
  };
  return entity.ok() && (holds(visible.local_entities) || holds(visible.directional_entities));
}

}  // namespace

std::optional<std::uint32_t> LightViews::shown_light(const FrameBuilder& frame, std::string_view name) {
  const World& world = frame.world();
  const auto entity = world.resource<SceneNames>().find("light", name);
  if (!entity.ok()) return std::nullopt;
  const std::vector<Entity>& lights = world.view_resource<VisibleLights>(frame.view().id).local_entities;
  const auto at = std::find(lights.begin(), lights.end(), *entity);
  if (at != lights.end()) return static_cast<std::uint32_t>(at - lights.begin());
  const Light* light = world.try_get<Light>(*entity);
  const bool directional = light != nullptr && light->kind == LightKind::directional;
  const auto [sentence, fresh] =
      told_.insert("view " + std::string(frame.visualizer()) + " shows no tile: the light " +
                   (directional ? "is directional and in no tile's list" : "reaches nothing in view"));
  if (fresh) frame.services().log.warning(*sentence);
  return std::nullopt;
}

Status LightViews::add_pass(FrameBuilder& frame) {
  const std::string_view shown = frame.visualizer();
  const std::string stem(shown.substr(0, shown.find(':')));
  const auto* named =
      std::find_if(std::begin(kViews), std::end(kViews), [&](const NamedView& v) { return v.name == stem; });
  if (named == std::end(kViews)) return {};
  if (frame.knobs().is("lights.culling", "brute"))
    return Error{ErrorKind::usage, "view " + stem + " needs lights.culling=tiled"};
  TargetOutput& target = frame.get<TargetOutput>();
  ViewDraw draw;
  draw.lights = frame.get<LightsOutputs>();
  draw.geometry = frame.get<GeometryOutputs>();
  draw.view = draw.lights.has_lists() ? named->view : LightView::nothing;
  if (shows_one_light(named->view)) {
    const std::string_view name = shown.substr(stem.size() + 1);
    if (is_taken(frame, named->view, name)) return {};
    const std::optional<std::uint32_t> light = shown_light(frame, name);
    if (!light) draw.view = LightView::nothing;
    draw.light = light.value_or(0);
    draw.opacity = 0.75f;
  }
  auto pipeline = frame.services().pipelines.get(view_pipeline(draw.view, target.format));
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  draw.pipeline = *pipeline;
  draw.sampler = *sampler;

  const ImageRef image = create_view_image(frame, stem, "lights", gpu::Format::rgba8_unorm);
  PassBuilder pass = frame.graph().add_pass(stem + "_view", "lights");
  declare_reads(pass, draw);
  draw.named = pass.write(image, gpu::Access::color_target);
  target.color = draw.picture = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, draw](PassContext& context) { record(frame, context, draw); });
  return {};
}

}  // namespace gloam
