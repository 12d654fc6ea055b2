// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/core/log.h"
#include "engine/core/once_log.h"
#include "engine/core/profiler.h"
#include "engine/gpu/device.h"
#include "engine/render/governor/budgets.h"
#include "engine/render/kept_frames/kept_frames.h"
#include "engine/render/modules_in_use/knobs_in_use.h"
#include "engine/render/modules_in_use/module_set.h"
#include "engine/render/renderer_options.h"
#include "engine/render/report/last_frame.h"
#include "engine/render/resources/frame_resources.h"
#include "engine/render/views/view_store.h"
#include "engine/render/worlds/world_slots.h"
#include "engine/schedule/schedule.h"

namespace gloam {

/// The owners of a renderer's data. What belongs to the frame that is being drawn lives in Frame.
struct RendererParts {
  /// options.modules goes into `modules`.
  explicit RendererParts(RendererOptions given);
  ~RendererParts();
  RendererParts(const RendererParts&) = delete;
  RendererParts& operator=(const RendererParts&) = delete;

  [[nodiscard]] FrameServices services(const KnobRegistry& view_knobs);
  [[nodiscard]] PipelineWait pipeline_wait();
  /// Requests the pipelines of the points beside the one in use, so that the next change finds them.
  void make_pipelines_ahead(const BudgetControl& control);
  /// Asserts that no frame is being drawn: modules and targets must not call the renderer. call: "render".
  void check_idle(std::string_view call) const;
  /// Receives the zones of systems and of the frame's steps; may be null.
  [[nodiscard]] Profiler* zones();

  RendererOptions options;  ///< `log` is the member below
  LogCategory log;
  ZonesForBoth zones_for_both;
  std::uint64_t frames_told = 0;  ///< to options.profiler
  gpu::DeviceUser device_user;
  OnceLog once;  ///< warnings to options.log
  KnobsInUse knobs;
  Budgets budgets;
  Schedule schedule;
  FrameResources resources;
  ModuleSet modules;
  WorldSlots worlds;
  ViewStore views;
  LastFrame last_frame;
  KeptFrames kept_frames;
  bool drawing = false;  ///< a frame is being drawn
};

/// Frees all that the renderer keeps for a world, except what frames in flight use.
void release_world(RendererParts& parts, std::uint64_t world);
/// Releases worlds that were destroyed without Renderer::release_world, with a warning.
void release_lost_worlds(RendererParts& parts);
/// Frees all that the renderer keeps for a view, except its resources of a world.
void release_view(RendererParts& parts, ViewId view);

}  // namespace gloam
