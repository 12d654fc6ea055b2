// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/render/camera/jitter.h"
#include "engine/render/camera/light_scale.h"
#include "engine/render/draws/levels.h"
#include "engine/render/frame/attempt.h"
#include "engine/render/frame/stages.h"

namespace gloam {
namespace {

/// Passes a view's settled results to the modules that the world demands.
void hand_out_results(World& world, ViewId view, const ModuleSet& modules, const FrameResults& results) {
  const std::vector<Module*> demanded = modules.demanded();
  results.for_each_settled(world_id(world), view.value, [&](const ResultKey& key, const FrameResult& result) {
    for (const Module* module : demanded)
      if (module->name() == key.module) module->take_result(world, view, key.name, result);
  });
}

/// RenderView::light_scale of a view. Views of automatic exposure and captures go by the brightness of the world:
/// captures are kept for pictures with other exposures.
float light_scale_of(const Frame& frame, const FrameView& own, const ViewStore& views) {
  if (own.request.target.light) return 1.0f;
  const bool captures = own.request.settings.purpose == ViewPurpose::capture && !own.main;
  if (has_stated_exposure(frame.world) && !captures) return light_scale(frame.world.resource<SceneEnvironment>());
  const ViewImages* last =
      views.find(own.main.value_or(own.request.settings.id));  // companions have that of their view
  const bool has_last = !captures && last != nullptr && last->drawn;
  return light_scale(scene_brightness(frame.world), has_last ? last->light_scale : 1.0f);
}

/// Whether the view is jittered (RenderView::jitter).
bool jitters(const Frame& frame, const FrameView& own, const ModuleSet& modules) {
  return !own.main && may_enlarge(own.request) &&
         modules.any_needs(&Module::wants_jitter, frame.world, frame.knobs_of(own));
}

/// RenderView::mip_bias of a jittered view.
float mip_bias(const RenderView& view, const ViewTarget& target) {
  if (target.width == 0) return 0.0f;
  const auto share = [](std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(whole);
  };
  return std::log2(std::max(share(view.width, target.width), share(view.height, target.height)));
}

/// Sets the camera of the view's previous frame, its jitter and mip bias. Views that are no companions come first.
void set_motion(Frame& frame, FrameView& own, RendererParts& parts) {
  RenderView& view = *own.view;
  parts.resources.motion.begin_view(view);
  if (own.main) {
    const auto main = std::ranges::find_if(
        frame.views, [&](const FrameView& other) { return other.request.settings.id == *own.main; });
    view.mip_bias = main->view->mip_bias;
    // A point of the mirror is at the same place in both pictures, which may differ in size.
    const vec2 scale = vec2(view.width, view.height) / vec2(main->view->width, main->view->height);
    if (main->view->jittered) apply_jitter(view, main->view->jitter * scale);
  } else if (jitters(frame, own, parts.modules)) {
    view.mip_bias = mip_bias(view, own.request.target);
    apply_jitter(view, jitter_point(view.frame - view.cut_frame));
  }
}

}  // namespace

Status run_systems(Frame& frame, std::optional<ViewId> view, RendererParts& parts) {
  const auto place = [&] { return "system '" + std::string(parts.schedule.failed_system()) + "'"; };
  return attempt(place, [&]() -> Status {
    if (view) {
      parts.schedule.run_view(*view, frame.world, *parts.options.executor, parts.zones());
    } else {
      parts.schedule.run(Stage::world, frame.world, *parts.options.executor, parts.zones());
    }
    return {};
  });
}

Status prepare_views(Frame& frame, RendererParts& parts) {
  const WorldSlot& slot = parts.worlds.slot_of(frame.world);
  const std::uint64_t id = slot.id;
  const std::uint64_t number = frame.redraw != nullptr && slot.frames > 0 ? slot.frames - 1 : slot.frames;
  for (FrameView& own : frame.views) {
    const ViewSettings& settings = own.request.settings;
    ViewTarget& target = own.request.target;
    if (!target.image && !jitters(frame, own, parts.modules)) target.width = target.height = 0;
    if (!own.main) GLOAM_TRY(parts.views.prepare(id, own.request));
    own.view =
        std::make_unique<RenderView>(make_view(settings, number, parts.resources.cuts.declare(id, settings, number)));
    own.view->main_view = own.main.value_or(settings.id);
    own.view->has_companions = own.has_companions;
    own.view->paced = !parts.budgets.empty();
    if (frame.view_levels) own.view->lod_pixels = lod_pixels(frame.knobs_of(own));
    own.view->light_scale = light_scale_of(frame, own, parts.views);
  }
  for (const bool companions : {false, true})
    for (FrameView& own : frame.views)
      if (own.main.has_value() == companions) set_motion(frame, own, parts);
  for (const FrameView& own : frame.views) {
    const ViewSettings& settings = own.request.settings;
    frame.world.set_view_resource(settings.id, *own.view);
    for (const Module* module : parts.modules.demanded())
      module->prepare_view(frame.world, settings.id, frame.knobs_of(own));
  }
  // Systems of companions come last: what they share with their main view, such as places in a shadow atlas, goes by
  // the needs of the main view.
  for (const bool companions : {false, true})
    for (const FrameView& own : frame.views) {
      if (own.main.has_value() != companions) continue;
      hand_out_results(frame.world, own.view->id, parts.modules, parts.resources.results);
      GLOAM_TRY(run_systems(frame, own.view->id, parts));
    }
  return {};
}

}  // namespace gloam
