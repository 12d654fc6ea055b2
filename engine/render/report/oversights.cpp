// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/report/oversights.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/nearest_name.h"
#include "engine/render/report/placeless.h"
#include "engine/scene/components.h"

namespace gloam {
namespace {

std::vector<Oversight> find_oversights(const World& world, const ModuleList& modules, WorldSlots& worlds) {
  std::vector<Oversight> all;
  if (auto absent = worlds.find_absent_mesh(world)) all.push_back(std::move(*absent));
  add_placeless<MeshInstance>(world, "has a MeshInstance but no WorldTransform: it is not drawn", all);
  for (const auto& module : modules) {
    std::vector<Oversight> more = module->oversights(world);
    std::move(more.begin(), more.end(), std::back_inserter(all));
  }
  return all;
}

void warn_of_view(const World& world, const ViewSettings& settings, const std::vector<std::string>& module_names,
                  OnceLog& once, LogSink& log) {
  const std::string view = "view " + std::to_string(settings.id.value);
  if (settings.follow_camera && settings.camera_entity != kNoEntity) {
    const std::string fault = camera_fault(world, settings.camera_entity);
    if (!fault.empty()) once.warning(log, view + " does not follow its camera, because " + fault);
  }
  for (const std::string& name : settings.without) {
    if (std::ranges::find(module_names, name) != module_names.end()) continue;
    const std::string meant = did_you_mean(name, module_names);
    if (!meant.empty()) once.warning(log, view + " leaves out the unknown module " + name + "; " + meant);
  }
}

}  // namespace

void warn_of_oversights(const World& world, std::span<const ViewRequest> requests, const ModuleList& modules,
                        WorldSlots& worlds, OnceLog& once, LogSink& log) {
  const std::string id = std::to_string(world_id(world));
  for (const Oversight& found : find_oversights(world, modules, worlds))
    once.warning(log, id + " " + found.fault, text_of(found.entity) + " " + found.fault);
  std::vector<std::string> names;
  for (const auto& module : modules) names.emplace_back(module->name());
  for (const ViewRequest& request : requests) warn_of_view(world, request.settings, names, once, log);
}

}  // namespace gloam
