// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/board.h"
#include "engine/render/draws/draw_lists.h"
#include "engine/render/frame_builder.h"
#include "engine/render/frame_report.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/modules_in_use/module_set.h"
#include "engine/render/view_request.h"

namespace gloam {

/// Draws one view of the last frame again, to copy results of its passes. add_copies: called after all passes of the
/// view are declared.
struct Redraw {
  ViewId view;
  std::function<Status(FrameBuilder&)> add_copies;
};

/// A view of a frame.
struct FrameView {
  ViewRequest request;
  std::unique_ptr<const KnobRegistry> own_knobs;  ///< with the view's overrides; null: it has none
  std::unique_ptr<RenderView> view;               ///< null before prepare_views
  std::optional<ViewId> main;                     ///< of a companion: the view that needs it
  bool has_companions = false;                    ///< its companions come just before it
};

/// Everything that belongs to one frame. Passes refer to it, so it keeps its place until the frame is submitted or
/// given up.
struct Frame {
  Frame(World& given_world, const KnobRegistry& given_knobs, const Redraw* given_redraw)
      : world(given_world), knobs(given_knobs), redraw(given_redraw) {}
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  [[nodiscard]] const KnobRegistry& knobs_of(const FrameView& own) const {
    return own.own_knobs == nullptr ? knobs : *own.own_knobs;
  }
  /// own: with its RenderView.
  [[nodiscard]] ViewQuery query_of(const FrameView& own) const {
    return {world, *own.view, own.request.settings.without, knobs_of(own)};
  }
  /// Whether any of the frame's views has a module that the world demands and that answers `question` with true.
  [[nodiscard]] bool any_needs(const ModuleSet& modules, ModuleSet::Question question) const {
    for (const FrameView& own : views)
      if (modules.any_needs(question, world, knobs_of(own))) return true;
    return false;
  }

  World& world;
  const KnobRegistry& knobs;                              ///< without overrides of views
  const Redraw* redraw;                                   ///< null: the frame is no redraw
  std::vector<FrameView> views;                           ///< in the order in which they are drawn
  bool caster_levels = false;                             ///< casters may be drawn with fewer triangles
  bool view_levels = false;                               ///< so may meshes in views with RenderView::lod_pixels
  FrameDraws draws;                                       ///< by view
  Board shared;                                           ///< FrameBuilder::shared
  std::vector<std::unique_ptr<FrameBuilder>> builders;    ///< by view; those whose passes are declared
  std::map<gpu::ImageHandle, LightTarget> light_targets;  ///< of captures, by image; the first one of each
  std::vector<ViewCounters> counters;                     ///< by view
};

}  // namespace gloam
