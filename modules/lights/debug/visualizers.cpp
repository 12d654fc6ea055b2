// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/visualizers.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"
#include "shaders/lights/shaders.h"

namespace gloam {
namespace {

/// The first four values match kCount in light_count_view.frag. `nothing` stands in for a visualizer without a list to
/// show.
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

/// Inputs for recording a visualizer pass.
struct ViewDraw {
  LightView view = LightView::nothing;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
  LightsOutputs lights;
  GeometryOutputs geometry;
  std::uint32_t light = 0;  ///< index of the shown light in the sorted local lights
  float opacity = 1.0f;     ///< LightView::nothing: opacity of black over the picture
  VisualizerTargets targets;
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
  std::span<const std::byte> constants;
  if (shows_one_light(draw.view)) constants = std::as_bytes(std::span(&draw.light, 1));
  if (draw.view == LightView::nothing) constants = std::as_bytes(std::span(&draw.opacity, 1));
  record_visualizer(context, frame.view(), draw.targets, draw.pipeline, bindings_of(frame, context, draw), constants);
}

}  // namespace

std::vector<VisualizerInfo> light_visualizers() {
  const std::string heat = ": black 0, blue 6, cyan 12, green 19, yellow 25, red 31, white 32 and more";
  std::vector<VisualizerInfo> views = {
      {"tile_masks", "lights", "", "number of lights in the CPU's mask of each 32x32 tile" + heat},
      {"light_culling", "lights", "LIGHT",
       "last culling test that the light passes in each tile: the CPU's tile mask (grey), the zBins (blue), the "
       "mask of the tile group (orange), the tile's list (green); red: the light is not in the list but reaches a "
       "pixel of the tile"},
      {"light_list", "lights", "LIGHT",
       "tiles whose list holds the light: blue, yellow at pixels that it reaches; red: reached by the light, but "
       "not in the list. With shadows.mode=deferred: yellow lit in the whole tile, green a visibility slot (brighter "
       "where more visible), blue unlit in the whole tile, magenta shaded from shadow maps"},
      {"lights_approx", "lights", "", "number of lights in each 8x8 tile after the approximate search" + heat},
      {"lights_accurate", "lights", "", "number of lights in each 8x8 tile after the accurate search" + heat},
      {"lights_difference", "lights", "",
       "number of lights that only the approximate search finds in each 8x8 tile" + heat}};
  for (VisualizerInfo& view : views) {
    view.knob = "lights.culling";
    view.value = "tiled";
  }
  return views;
}

namespace {

/// Whether a later module draws this visualizer for this light (LightListViewTaken).
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

  PassBuilder pass = frame.graph().add_pass(stem + "_view", "lights");
  declare_reads(pass, draw);
  draw.targets = write_visualizer_targets(frame, pass, stem, "lights", gpu::Format::rgba8_unorm);
  pass.execute([&frame, draw](PassContext& context) { record(frame, context, draw); });
  return {};
}

}  // namespace gloam
