// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/frame_report.h"
#include "engine/render/module.h"
#include "engine/render/modules_in_use/pipeline_wait.h"
#include "engine/render/resources/frame_resources.h"
#include "engine/render/view.h"
#include "engine/schedule/schedule.h"

namespace gloam {

/// A view about which modules are asked.
struct ViewQuery {
  const World& world;
  const RenderView& view;
  std::span<const std::string> without;  ///< ViewSettings::without
  const KnobRegistry& knobs;             ///< the view's
};

/// The modules of a renderer: which of them the world and the views of a frame demand, which took part, and which give
/// their memory back. Modules are named by their index in list().
class ModuleSet {
 public:
  /// A question that a module answers from world and knobs, e.g. &Module::needs_casters.
  using Question = bool (Module::*)(const World&, const KnobRegistry&) const;

  explicit ModuleSet(ModuleList modules) : modules_(std::move(modules)), uses_(modules_.size()) {}
  ModuleSet(const ModuleSet&) = delete;
  ModuleSet& operator=(const ModuleSet&) = delete;

  [[nodiscard]] const ModuleList& list() const { return modules_; }
  /// Adds the knobs and systems of all modules.
  void add_to(KnobRegistry& knobs, Schedule& schedule);

  /// Begins a frame: asks each module whether the world needs it, and enables its systems if so.
  void begin_frame(const World& world, Schedule& schedule);
  /// After begin_frame: modules that are switched off with each of these knobs (those of the frame and of its views)
  /// are not demanded.
  void switch_off(const World& world, std::span<const KnobRegistry* const> knobs, Schedule& schedule);
  /// After switch_off: modules that are not demanded leave the world (Module::leave_world).
  void leave(World& world) const;
  /// The answer of the last begin_frame and switch_off.
  [[nodiscard]] const Demand& demand(std::size_t index) const { return uses_[index].demand; }
  /// The modules that the world demands, in list order.
  [[nodiscard]] std::vector<Module*> demanded() const;
  /// Whether `question` is true for any module that the world demands.
  [[nodiscard]] bool any_needs(Question question, const World& world, const KnobRegistry& knobs) const;
  /// The most frames that any module which the world demands takes to rest (Module::frames_to_rest).
  [[nodiscard]] std::uint32_t frames_to_rest(const World& world, const KnobRegistry& knobs) const;
  /// Whether `question` is true for any module that may draw in the view: demanded by the world and the view, and not
  /// left out.
  [[nodiscard]] bool view_needs(Question question, const ViewQuery& query) const;

  /// Whether a module that may draw in the view shows surfaces there (Module::shows_surfaces).
  [[nodiscard]] bool view_shows_surfaces(const ViewQuery& query) const;

  /// Decides which modules take part in a view: those that may draw there and whose pipelines are ready, or that the
  /// frame waits for. Returns them in list order.
  [[nodiscard]] std::vector<Module*> begin_view(const ViewQuery& query, const PipelineWait& wait);
  /// Of the view that began last: the modules that take part.
  [[nodiscard]] std::vector<Module*> taking_part() const;
  /// Of the view that began last: why it does not demand the module with this visualizer. Empty if it does, or if no
  /// module has this visualizer.
  [[nodiscard]] std::string reason_of_idle_visualizer(std::string_view name, const ViewQuery& query) const;

  /// Whether the pipelines of all modules that the last frame showed are ready with these knobs. Missing ones are
  /// compiled in the background.
  [[nodiscard]] bool shown_pipelines_ready(const KnobRegistry& knobs, const PipelineWait& wait) const;

  /// Ends a submitted frame: frees the memory of modules that no view has demanded for kFramesUntilRelease frames, and
  /// the pipelines of modules that no world has demanded for as long.
  void end_frame(FrameResources& resources);
  /// Ends a frame that the GPU does not execute. `frame`: its Device::frame_number.
  void give_up_frame(std::uint64_t frame);

  /// Frees what the modules keep for a view in any world.
  void release_view(ViewId view);
  /// Releases the modules that took part in views of which `gone` is true (world_id and id), and in no others.
  void release_modules_of(const std::function<bool(std::uint64_t world, std::uint32_t view)>& gone,
                          FrameResources& resources);
  /// Frees the GPU memory of all modules.
  void release_all();

 private:
  struct Use {
    Demand demand;                    ///< of the world
    bool in_frame = false;            ///< a view of the current frame demands it
    bool in_view = false;             ///< takes part in the view that began last
    std::uint32_t idle_frames = 0;    ///< since a view demanded it
    std::uint32_t absent_frames = 0;  ///< since a world demanded it
    /// The views (world_id and id) that it has taken part in since it was released last.
    std::set<std::pair<std::uint64_t, std::uint32_t>> views;
    /// Those of them whose frames waited for its pipelines. It stays in them when frames no longer wait, although its
    /// list (Module::pipelines) may name more pipelines than these frames have made.
    std::set<std::pair<std::uint64_t, std::uint32_t>> waited;
  };
  [[nodiscard]] bool may_draw(std::size_t index, const ViewQuery& query) const;
  [[nodiscard]] bool take_part(std::size_t index, const ViewQuery& query, const PipelineWait& wait);
  /// Frees the memory of a module: its own, its results and its history.
  void release(std::size_t index, FrameResources& resources);

  ModuleList modules_;
  std::vector<Use> uses_;  ///< by module
};

}  // namespace gloam
