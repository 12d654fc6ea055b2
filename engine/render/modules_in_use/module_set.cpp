// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/module_set.h"

#include <algorithm>

#include "engine/render/worlds/world_id.h"

namespace gloam {

void ModuleSet::add_to(KnobRegistry& knobs, Schedule& schedule) {
  for (const auto& module : modules_) {
    module->knobs(knobs);
    module->add_systems(schedule);
  }
}

void ModuleSet::begin_frame(const World& world, Schedule& schedule) {
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    uses_[i].demand = modules_[i]->demand(world, nullptr);
    uses_[i].in_frame = false;
    uses_[i].in_view = false;
    schedule.set_enabled(modules_[i]->name(), uses_[i].demand.needed);
  }
}

void ModuleSet::switch_off(const World& world, std::span<const KnobRegistry* const> knobs, Schedule& schedule) {
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    Demand& demand = uses_[i].demand;
    if (!demand.needed) continue;
    std::string reason;
    const bool off = std::ranges::all_of(knobs, [&](const KnobRegistry* values) {
      reason = modules_[i]->switched_off(world, *values);
      return !reason.empty();
    });
    if (!off) continue;
    demand = {false, demand.reason + ", but " + reason};
    schedule.set_enabled(modules_[i]->name(), false);
  }
}

void ModuleSet::leave(World& world) const {
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (!uses_[i].demand.needed) modules_[i]->leave_world(world);
}

std::vector<Module*> ModuleSet::demanded() const {
  std::vector<Module*> found;
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].demand.needed) found.push_back(modules_[i].get());
  return found;
}

bool ModuleSet::any_needs(Question question, const World& world, const KnobRegistry& knobs) const {
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].demand.needed && ((*modules_[i]).*question)(world, knobs)) return true;
  return false;
}

std::uint32_t ModuleSet::frames_to_rest(const World& world, const KnobRegistry& knobs) const {
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].demand.needed) most = std::max(most, modules_[i]->frames_to_rest(world, knobs));
  return most;
}

bool ModuleSet::may_draw(std::size_t index, const ViewQuery& query) const {
  const Module& module = *modules_[index];
  return std::ranges::find(query.without, module.name()) == query.without.end() && uses_[index].demand.needed &&
         module.switched_off(query.world, query.knobs).empty() && module.demand(query.world, &query.view).needed;
}

bool ModuleSet::view_shows_surfaces(const ViewQuery& query) const {
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (modules_[i]->shows_surfaces(query.world, query.view) && may_draw(i, query)) return true;
  return false;
}

bool ModuleSet::view_needs(Question question, const ViewQuery& query) const {
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (may_draw(i, query) && ((*modules_[i]).*question)(query.world, query.knobs)) return true;
  return false;
}

bool ModuleSet::take_part(std::size_t index, const ViewQuery& query, const PipelineWait& wait) {
  if (!may_draw(index, query)) return false;
  const Module& module = *modules_[index];
  Use& use = uses_[index];
  const std::pair key(world_id(query.world), query.view.id.value);
  use.in_frame = true;
  use.views.insert(key);
  if (module.essential()) return true;
  if (wait.readiness == Readiness::wait) {
    use.waited.insert(key);
    return true;
  }
  PipelineList needed;
  module.pipelines(query.knobs, wait.device, needed);
  const bool ready = wait.pipelines.request(needed, wait.log);
  if (ready) use.waited.erase(key);
  return ready || use.waited.contains(key);
}

std::vector<Module*> ModuleSet::begin_view(const ViewQuery& query, const PipelineWait& wait) {
  for (std::size_t i = 0; i < modules_.size(); ++i) uses_[i].in_view = take_part(i, query, wait);
  return taking_part();
}

std::vector<Module*> ModuleSet::taking_part() const {
  std::vector<Module*> found;
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].in_view) found.push_back(modules_[i].get());
  return found;
}

std::string ModuleSet::reason_of_idle_visualizer(std::string_view name, const ViewQuery& query) const {
  const std::string_view stem = name.substr(0, name.find(':'));
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    Demand demand = uses_[i].demand.needed ? modules_[i]->demand(query.world, &query.view) : uses_[i].demand;
    if (const std::string off = modules_[i]->switched_off(query.world, query.knobs); demand.needed && !off.empty())
      demand = {false, off};
    if (uses_[i].in_view || demand.needed) continue;
    for (const VisualizerInfo& info : modules_[i]->visualizers())
      if (info.name == stem) return demand.reason;
  }
  return {};
}

bool ModuleSet::shown_pipelines_ready(const KnobRegistry& knobs, const PipelineWait& wait) const {
  PipelineList needed;
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].demand.needed && uses_[i].idle_frames == 0) modules_[i]->pipelines(knobs, wait.device, needed);
  return wait.pipelines.request(needed, wait.log);
}

void ModuleSet::end_frame(FrameResources& resources) {
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    Use& use = uses_[i];
    use.idle_frames = use.in_frame ? 0 : use.idle_frames + 1;
    use.absent_frames = use.demand.needed ? 0 : use.absent_frames + 1;
    if (use.idle_frames == kFramesUntilRelease) release(i, resources);
    // Repeated, because a pipeline that was being compiled may have been added since.
    if (use.absent_frames != 0 && use.absent_frames % kFramesUntilRelease == 0)
      resources.pipelines.release(modules_[i]->name());
  }
}

void ModuleSet::give_up_frame(std::uint64_t frame) {
  for (std::size_t i = 0; i < modules_.size(); ++i)
    if (uses_[i].in_frame) modules_[i]->give_up_frame(frame);
}

void ModuleSet::release_view(ViewId view) {
  for (const auto& module : modules_) module->release_view(view);
}

void ModuleSet::release(std::size_t index, FrameResources& resources) {
  modules_[index]->release();
  resources.forget_module(modules_[index]->name());
  uses_[index].views.clear();
  uses_[index].waited.clear();
}

void ModuleSet::release_modules_of(const std::function<bool(std::uint64_t world, std::uint32_t view)>& gone,
                                   FrameResources& resources) {
  for (std::size_t i = 0; i < uses_.size(); ++i) {
    const auto is_gone = [&](const auto& view) { return gone(view.first, view.second); };
    std::erase_if(uses_[i].waited, is_gone);
    const std::size_t erased = std::erase_if(uses_[i].views, is_gone);
    if (erased > 0 && uses_[i].views.empty()) release(i, resources);
  }
}

void ModuleSet::release_all() {
  for (const auto& module : modules_) module->release();
}

}  // namespace gloam
