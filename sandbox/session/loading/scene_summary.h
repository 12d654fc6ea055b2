// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/render/module.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/keys/registry.h"

namespace gloam {

/// The facts that `inspect` prints about a scene.
struct SceneSummary {
  std::string scene;
  std::string name;
  std::uint64_t nodes = 0;
  std::uint64_t meshes = 0;
  std::uint64_t triangles = 0;  ///< each mesh counted once
  std::uint64_t instances = 0;
  std::uint64_t drawn_triangles = 0;  ///< sum over all instances
  std::uint64_t materials = 0;
  std::uint64_t textures = 0;
  std::uint64_t images = 0;
  std::uint64_t lights = 0;
  std::uint64_t skins = 0;
  std::vector<std::string> light_names;  ///< of the scene, without the default sun
  bool default_light = false;            ///< add_default_light() has added one
  std::vector<std::string> cameras;
  std::vector<std::string> animations;

  struct ModuleDemand {
    std::string name;
    bool needed = false;
    std::string reason;
  };
  std::vector<ModuleDemand> modules;
  std::vector<std::string> warnings;  ///< Module::warnings() of all modules
};

[[nodiscard]] SceneSummary summarize_scene(const std::string& scene, const World& world, const SceneInfo& info,
                                           const KeyRegistry& registry, const ModuleList& modules);

/// The summary as readable text.
[[nodiscard]] std::string summary_text(const SceneSummary& summary);
/// The summary as JSON: {"version": 1, "scene", counts…, "light_names": […],
/// "default_light", "cameras": […], "animations": […], "modules": [{"name",
/// "built", "demanded", "reason"}], "warnings": […]}. "built" is always true: it is kept for readers of version 1.
[[nodiscard]] std::string summary_json(const SceneSummary& summary);

}  // namespace gloam
