// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "engine/render/frame/stages.h"
#include "engine/render/modules_in_use/visualizers.h"
#include "engine/render/views/view_checks.h"

namespace gloam {
namespace {

/// A view of the frame, with its knobs.
Result<FrameView> begin_view(const Frame& frame, const ViewRequest& request, const ModuleList& modules) {
  FrameView own;
  own.request = request;
  GLOAM_TRY(check_visualizer_name(modules, request.settings.visualizer));
  if (request.settings.knobs.empty()) return own;
  auto overridden = std::make_unique<KnobRegistry>(frame.knobs);
  for (const KnobOverride& knob : request.settings.knobs) GLOAM_TRY(overridden->set(knob.name, knob.value));
  own.own_knobs = std::move(overridden);
  return own;
}

/// Puts the companions of a view, whose settings are settled, into the frame.
Status add_companions_of(Frame& frame, FrameView& main, const ModuleSet& modules) {
  const ViewSettings& settings = main.request.settings;
  if (settings.purpose == ViewPurpose::capture || main.request.target.light) return {};
  CompanionViews companions(settings.id);
  for (const Module* module : modules.demanded()) {
    const bool left_out = std::ranges::find(settings.without, module->name()) != settings.without.end();
    if (!left_out) module->companion_views(frame.world, settings, frame.knobs_of(main), companions);
  }
  for (const ViewSettings& companion : companions.all()) {
    Result<FrameView> own = begin_view(frame, {.settings = companion, .target = {}}, modules.list());
    if (!own.ok()) return own.error();
    own->main = settings.id;
    frame.views.push_back(std::move(*own));
    main.has_companions = true;
  }
  return {};
}

}  // namespace

Status begin_views(Frame& frame, std::span<const ViewRequest> requests, const ModuleList& modules) {
  check_ids(requests);
  for (const ViewRequest& request : requests) {
    Result<FrameView> own = begin_view(frame, request, modules);
    if (!own.ok()) return own.error();
    frame.views.push_back(std::move(*own));
  }
  return {};
}

Status add_companions(Frame& frame, const ModuleSet& modules, const gpu::Device& device) {
  std::vector<FrameView> requested = std::exchange(frame.views, {});
  for (FrameView& own : requested) {
    GLOAM_TRY(acquire_target(device, own.request));
    check_target(device, own.request);
    follow_camera(frame.world, own.request.settings);
    GLOAM_TRY(check_camera_pose(frame.world, own.request.settings));
    check_settings(own.request.settings);
    GLOAM_TRY(check_size(own.request.settings));
    GLOAM_TRY(add_companions_of(frame, own, modules));
    frame.views.push_back(std::move(own));
  }
  return {};
}

}  // namespace gloam
