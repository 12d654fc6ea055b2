// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

/// A scene made by code; each shows one effect.
struct BuiltinScene {
  std::string_view name;
  std::string_view shows;
  void (*build)(World& world, SceneInfo& info);
};

/// In the order in which `gloam scenes` lists them.
[[nodiscard]] std::span<const BuiltinScene> builtin_scenes();

/// Usage error that lists the names when there is none of this name (without "builtin:").
[[nodiscard]] Result<const BuiltinScene*> find_builtin_scene(std::string_view name);

}  // namespace gloam
