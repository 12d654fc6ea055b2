// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"

namespace gloam {

class SceneNames;

/// The lights named in a comma-separated list. Input error when a name is unknown or shared by two lights; the message
/// names `key`.
[[nodiscard]] Result<std::vector<Entity>> resolve_light_names(const SceneNames& scene, std::string_view names,
                                                              std::string_view key);
/// The same with the world's SceneNames.
[[nodiscard]] Result<std::vector<Entity>> resolve_light_names(const World& world, std::string_view names,
                                                              std::string_view key);

}  // namespace gloam
