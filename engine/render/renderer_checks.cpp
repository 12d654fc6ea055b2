// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// What a renderer says about calls and worlds that make no sense.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "engine/core/nearest_name.h"
#include "engine/render/placeless.h"
#include "engine/render/renderer_state.h"

namespace gloam {

const RenderSlot& Renderer::State::slot_of(const World& world) const {
  const RenderSlot* slot = world.try_resource<RenderSlot>();
  GLOAM_ASSERT(slot != nullptr, "a world must be prepared by the renderer that draws it (Renderer::prepare_world)");
  GLOAM_ASSERT(slot->renderer.lock() == token,
               "the world was prepared by another renderer: each renderer draws the worlds that it has prepared");
  return *slot;
}

void Renderer::State::take_world(World& world, std::uint64_t frames) {
  const auto life = std::make_shared<const WorldToken>();
  worlds[next_slot] = life;
  world.set_resource(RenderSlot{.value = next_slot++, .frames = frames, .renderer = token, .token = life});
}

void Renderer::State::check_idle(std::string_view call) const {
  GLOAM_ASSERT(!drawing, "Renderer::" + std::string(call) + " is called while a frame is being drawn");
}

void Renderer::State::warn_once(const std::string& sentence) {
  if (told.insert(sentence).second) options.log->warning(sentence);
}

std::vector<VisualizerInfo> Renderer::State::visualizers() const {
  std::vector<VisualizerInfo> all = {
      {"none", "engine", "", "the lit picture"},
      {"albedo", "engine", "", "base colour without light"},
      {"normal", "engine", "", "shading normal: x, y, z as red, green, blue; -1 is 0, 0 is 128 and 1 is 255"},
      {"depth", "engine", "", "distance: white near, grey far, black sky"}};
  for (const auto& module : options.modules)
    for (VisualizerInfo& info : module->visualizers()) all.push_back(std::move(info));
  return all;
}

Status Renderer::State::check_visualizer_name(std::string_view name) const {
  if (name == "none") return {};
  const std::string_view stem = name.substr(0, name.find(':'));
  std::vector<std::string> names;
  std::string list;
  for (const VisualizerInfo& info : visualizers()) {
    if (info.name == stem) return {};
    names.push_back(info.name);
    list += (list.empty() ? "" : ", ") + info.name + (info.argument.empty() ? "" : ":" + info.argument);
  }
  return Error{ErrorKind::usage,
               "unknown view " + std::string(name) + "; " + did_you_mean(stem, names) + "there are " + list};
}

std::optional<Oversight> Renderer::State::find_absent_mesh(const World& world) {
  const SceneAssets& assets = world.resource<SceneAssets>();
  const std::size_t meshes = assets.meshes.size();
  CheckedInstances& checked = checked_instances[slot_of(world).value];
  if (meshes < checked.meshes || assets.revision() != checked.revision) checked.tick = 0;
  checked.meshes = meshes;
  checked.revision = assets.revision();
  std::optional<Oversight> absent;
  const auto check = [&](std::span<const Entity> entities, std::span<const MeshInstance> instances) {
    for (std::size_t i = 0; i < instances.size() && !absent; ++i) {
      const std::uint32_t mesh = instances[i].mesh;
      const bool destroyed = mesh < meshes && assets.is_destroyed(AssetKind::mesh, mesh);
      if (mesh < meshes && !destroyed) continue;
      absent = Oversight{entities[i], "has a MeshInstance of mesh " + std::to_string(mesh) +
                                          (destroyed ? ", which was destroyed: it is not drawn"
                                                     : ", and SceneAssets has " + std::to_string(meshes) +
                                                           " meshes: it is not drawn")};
    }
  };
  checked.tick = world.view<const MeshInstance>().changed_since<const MeshInstance>(checked.tick, check);
  return absent;
}

void Renderer::State::warn_of_oversights(const World& world, std::span<const ViewRequest> requests) {
  std::vector<Oversight> oversights;
  if (auto absent = find_absent_mesh(world)) oversights.push_back(std::move(*absent));
  add_placeless<MeshInstance>(world, "has a MeshInstance but no WorldTransform: it is not drawn", oversights);
  for (const auto& module : options.modules) {
    std::vector<Oversight> more = module->oversights(world);
    std::move(more.begin(), more.end(), std::back_inserter(oversights));
  }
  for (const Oversight& found : oversights) {
    if (told.insert(std::to_string(slot_of(world).value) + " " + found.fault).second)
      options.log->warning(text_of(found.entity) + " " + found.fault);
  }
  for (const ViewRequest& request : requests) {
    const ViewSettings& settings = request.settings;
    const std::string view = "view " + std::to_string(settings.id.value);
    if (settings.follow_camera && settings.camera_entity != kNoEntity) {
      const std::string fault = camera_fault(world, settings.camera_entity);
      if (!fault.empty()) warn_once(view + " does not follow its camera, because " + fault);
    }
    for (const std::string& name : settings.without) {
      std::vector<std::string> names;
      for (const auto& module : options.modules) names.emplace_back(module->name());
      const std::string meant = did_you_mean(name, names);
      if (std::ranges::find(names, name) == names.end() && !meant.empty())
        warn_once(view + " leaves out the unknown module " + name + "; " + meant);
    }
  }
}

void Renderer::State::release_lost_worlds() {
  for (auto at = worlds.begin(); at != worlds.end();) {
    const bool lost = at->second.expired();
    if (lost) {
      if (scenes.contains(at->first))
        options.log->warning(
            "a world was destroyed without Renderer::release_world: its GPU memory was kept until now");
      release_slot(at->first);
    }
    at = lost ? worlds.erase(at) : std::next(at);
  }
}

}  // namespace gloam
