// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// A scene built by code. Each shows one effect; dusk shows all of them.
struct BuiltinScene {
  std::string_view name;
  std::string_view shows;
  void (*build)(World& world, SceneInfo& info);
};

/// All built-in scenes, in the order in which `gloam scenes` lists them.
[[nodiscard]] std::span<const BuiltinScene> builtin_scenes();

/// Finds a scene by its name, without "builtin:". An unknown name is ErrorKind::usage; the message lists all names.
[[nodiscard]] Result<const BuiltinScene*> find_builtin_scene(std::string_view name);

}  // namespace gloam
