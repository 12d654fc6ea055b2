// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/scene_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "sandbox/output/json_text.h"
#include "sandbox/session/loading/default_light.h"

namespace gloam {
namespace {

std::uint64_t triangles_of(const Mesh& mesh) {
  std::uint64_t count = 0;
  for (const Primitive& primitive : mesh.primitives) count += primitive.indices.size() / 3;
  return count;
}

/// The counts with their names, in the order of the output.
std::vector<std::pair<const char*, std::uint64_t>> counts_of(const SceneSummary& summary) {
  return {{"nodes", summary.nodes},
          {"meshes", summary.meshes},
          {"triangles", summary.triangles},
          {"instances", summary.instances},
          {"drawn_triangles", summary.drawn_triangles},
          {"materials", summary.materials},
          {"textures", summary.textures},
          {"images", summary.images},
          {"lights", summary.lights},
          {"skins", summary.skins}};
}

constexpr std::size_t kMostNames = 24;  // in one line of text

/// At most `most` names; the others are counted.
std::string joined(const std::vector<std::string>& names, std::size_t most = ~std::size_t{0}) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + (names[i].empty() ? "(no name)" : names[i]);
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return names.empty() ? "none" : text;
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size() + 1), ' ');
  return text;
}

std::string verdict(const SceneSummary::ModuleDemand& module) {
  return module.needed ? "called for" : "not called for";
}

}  // namespace

SceneSummary summarize_scene(const std::string& scene, const World& world, const SceneInfo& info,
                             const KeyRegistry& registry, const ModuleList& modules) {
  const auto& assets = world.resource<SceneAssets>();
  SceneSummary out;
  out.scene = scene;
  out.name = info.name;
  const auto* added = world.try_resource<DefaultLight>();
  const Entity sun = added != nullptr ? added->sun : kNoEntity;
  out.default_light = added != nullptr;
  world.view<const WorldTransform>().each([&](Entity entity, const WorldTransform&) {
    if (entity == sun) return;  // no node of the file
    ++out.nodes;
    if (registry.is_light(world, entity)) ++out.lights;
  });
  for (const Mesh& mesh : assets.meshes) out.triangles += triangles_of(mesh);
  world.view<const MeshInstance>().each([&](const MeshInstance& instance) {
    ++out.instances;
    if (instance.mesh < assets.meshes.size()) out.drawn_triangles += triangles_of(assets.meshes[instance.mesh]);
  });
  out.meshes = assets.meshes.size();
  out.materials = assets.materials.size();
  out.textures = assets.textures.size();
  out.images = assets.images.size();
  out.skins = assets.skins.size();
  const auto& names = world.resource<SceneNames>();
  for (std::string& name : names.names("light"))
    if (added == nullptr || name != names.name_of(sun)) out.light_names.push_back(std::move(name));
  for (const Entity camera : info.cameras) out.cameras.emplace_back(names.name_of(camera));
  for (const AnimationClip& clip : assets.clips) out.animations.push_back(clip.name);
  for (const auto& module : modules) {
    Demand demand = module->demand(world, nullptr);
    out.modules.push_back(
        {.name = std::string(module->name()), .needed = demand.needed, .reason = std::move(demand.reason)});
    for (std::string& warning : module->warnings(world)) out.warnings.push_back(std::move(warning));
  }
  return out;
}

std::string summary_text(const SceneSummary& summary) {
  constexpr std::size_t kColumn = 18;
  std::string text = padded("scene", kColumn) + summary.scene + "\n";
  for (const auto& [name, count] : counts_of(summary)) text += padded(name, kColumn) + std::to_string(count) + "\n";
  text += padded("light names", kColumn) + joined(summary.light_names, kMostNames) + "\n";
  if (summary.default_light) text += padded("default light", kColumn) + kDefaultLightSentence + "\n";
  text += padded("cameras", kColumn) + joined(summary.cameras) + "\n";
  text += padded("animations", kColumn) + joined(summary.animations) + "\n";
  text += "modules\n";
  for (const SceneSummary::ModuleDemand& module : summary.modules) {
    const std::string reason = module.reason.empty() ? "" : ": " + module.reason;
    text += "  " + padded(module.name, kColumn - 2) + verdict(module) + reason + "\n";
  }
  for (const std::string& warning : summary.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string summary_json(const SceneSummary& summary) {
  Json json = {{"version", 1}, {"scene", summary.scene}, {"name", summary.name}};
  for (const auto& [name, count] : counts_of(summary)) json[name] = count;
  json["light_names"] = summary.light_names;
  json["default_light"] = summary.default_light;
  json["cameras"] = summary.cameras;
  json["animations"] = summary.animations;
  json["modules"] = Json::array();
  for (const SceneSummary::ModuleDemand& module : summary.modules) {
    json["modules"].push_back(
        {{"name", module.name}, {"built", true}, {"demanded", module.needed}, {"reason", module.reason}});
  }
  json["warnings"] = summary.warnings;
  return json_text(json);
}

}  // namespace gloam
