// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/light_names.h"

#include <string>

#include "engine/scene/resources.h"

namespace gloam {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

Result<std::vector<Entity>> resolve_light_names(const SceneNames& scene, std::string_view names, std::string_view key) {
  std::vector<Entity> lights;
  while (!names.empty()) {
    const std::size_t comma = names.find(',');
    const std::string_view name = trimmed(names.substr(0, comma));
    names = comma == std::string_view::npos ? std::string_view() : names.substr(comma + 1);
    if (name.empty()) continue;
    auto light = scene.find("light", name);
    if (!light.ok()) return Error{ErrorKind::input, std::string(key) + ": " + light.error().message};
    lights.push_back(*light);
  }
  return lights;
}

Result<std::vector<Entity>> resolve_light_names(const World& world, std::string_view names, std::string_view key) {
  return resolve_light_names(world.resource<SceneNames>(), names, key);
}

}  // namespace gloam
