// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/visualizers.h"

#include <algorithm>
#include <iterator>
#include <optional>

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

DrawProgram program_of(FrameBuilder& frame, LightView view) {
  using namespace shaders::lights;
  DrawProgram program{
      .fragment = light_count_view_frag, .constants = visualizer_constants(frame), .blend = gpu::BlendMode::alpha};
  if (view == LightView::culling) program.fragment = light_culling_view_frag;
  if (view == LightView::list) program.fragment = light_list_view_frag;
  if (view == LightView::nothing) program.fragment = light_nothing_view_frag;
  if (shows_counts(view)) program.constants.set("kCount", static_cast<std::uint32_t>(view));
  return program;
}

}  // namespace

std::vector<VisualizerInfo> light_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"tile_masks", "lights", "", "number of lights in the CPU's mask of each 32x32 tile"},
      {"light_culling", "lights", "LIGHT",
       "last culling test that the light passes in each tile: the CPU's tile mask (grey), the zBins (blue), the "
       "mask of the tile group (orange), the tile's list (green); red: the light is not in the list but reaches a "
       "pixel of the tile"},
      {"light_list", "lights", "LIGHT",
       "tiles whose list holds the light: blue, yellow at pixels that it reaches; red: reached by the light, but "
       "not in the list. With shadows.mode=deferred: yellow lit in the whole tile, green a visibility slot (brighter "
       "where more visible), blue unlit in the whole tile, magenta shaded from shadow maps"},
      {"lights_approx", "lights", "", "number of lights in each 8x8 tile after the approximate search"},
      {"lights_accurate", "lights", "", "number of lights in each 8x8 tile after the accurate search"},
      {"lights_difference", "lights", "", "number of lights that only the approximate search finds in each 8x8 tile"}};
  for (VisualizerInfo& view : views) {
    view.knob = kLightCulling.name;
    view.value = text_of(kLightCulling, LightCulling::tiled);
    view.shows_lists = true;
    if (view.argument.empty()) view.heat = {.most = 31.0, .counts = true};
  }
  return views;
}

namespace {

/// Whether a later module draws this visualizer for this light (LightListViewTaken).
bool is_taken(const FrameBuilder& frame, LightView view, std::string_view light) {
  if (view != LightView::list || frame.find<LightListViewTaken>() == nullptr) return false;
  const auto entity = frame.world().resource<SceneNames>().find("light", light);
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  const auto is_listed = [&](const std::vector<Entity>& lights) {
    return std::find(lights.begin(), lights.end(), *entity) != lights.end();
  };
  return entity.ok() && (is_listed(visible.local_entities) || is_listed(visible.directional_entities));
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
  LogCategory log(frame.services().log, frame.module());
  once_log_.warning(log, "view " + std::string(frame.visualizer()) + " shows no tile: the light " +
                             (directional ? "is directional and in no tile's list" : "reaches nothing in view"));
  return std::nullopt;
}

void LightViews::add_pass(FrameBuilder& frame) {
  const std::string_view shown = frame.visualizer();
  const std::string stem(shown.substr(0, shown.find(':')));
  const auto* named =
      std::find_if(std::begin(kViews), std::end(kViews), [&](const NamedView& v) { return v.name == stem; });
  if (named == std::end(kViews)) return;
  if (frame.knobs().value(kLightCulling) == LightCulling::brute)
    return frame.fail(
        {ErrorKind::usage, "view " + stem + " needs " + assignment_of(kLightCulling, LightCulling::tiled)});
  const LightsOutputs& lights = frame.get<LightsOutputs>();
  LightView view = lights.has_lists() ? named->view : LightView::nothing;
  std::optional<std::uint32_t> light;  // index of the shown light in the sorted local lights
  if (shows_one_light(named->view)) {
    const std::string_view name = shown.substr(stem.size() + 1);
    if (is_taken(frame, named->view, name)) return;
    light = shown_light(frame, name);
    if (!light) view = LightView::nothing;
  }
  DrawPass pass(frame, stem + "_view", program_of(frame, view));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, lights);
  if (view == LightView::nothing)
    pass.push(shows_one_light(named->view) ? 0.75f : 1.0f);  // opacity of black over the picture
  else if (light)
    pass.push(*light);
  add_visualizer_targets(frame, pass, stem,
                         shows_counts(named->view) ? gpu::Format::rgba16_float : gpu::Format::rgba8_unorm);
  pass.draw_triangle();
}

}  // namespace gloam
