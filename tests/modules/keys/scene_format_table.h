// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "engine/scene/assets.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/keys/table.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "tests/support/gltf_files.h"

namespace gloam::test {

inline SceneValue number(double value) {
  return {.kind = SceneValue::Kind::number, .number = value, .integral = value == std::floor(value)};
}
inline SceneValue yes_or_no(bool value) { return {.kind = SceneValue::Kind::boolean, .boolean = value}; }
inline SceneValue text(std::string value) { return {.kind = SceneValue::Kind::text, .text = std::move(value)}; }
inline SceneValue list(std::initializer_list<double> values) {
  SceneValue array{.kind = SceneValue::Kind::array};
  for (const double value : values) array.items.push_back(number(value));
  return array;
}

/// Target of the keys in this test: a light of the given kind, a material, a scene's environment, and a folder with a
/// file.
struct Place {
  World world;
  TemporaryFolder folder;
  KeyTarget target;

  Place(const ModuleList& modules, LightKind kind) : target{world, kNoEntity, 0, folder.path()} {
    prepare_scene_world(world);
    for (const auto& module : modules) module->register_components(world);
    static_cast<void>(folder.write("file.bin", "content"));
    Light light;
    light.kind = kind;
    target.entity = world.create(light);
    world.resource<SceneAssets>().materials.emplace_back();
  }
};

/// Checks one member after a key was set. `wanted`: it must have the value of the key; false: its default.
using Look = std::function<void(const Place&, bool wanted)>;

struct Line {
  KeyElement on;
  const char* name;
  const char* module;
  KeyType type;
  const char* unit;
  const char* default_text;
  SceneValue good;
  std::vector<SceneValue> bad;
  Look look;
  LightKind light = LightKind::spot;
};

/// All lines of the scene format's table.
[[nodiscard]] std::vector<Line> scene_format_table();

}  // namespace gloam::test
