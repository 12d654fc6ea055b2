// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "engine/ecs/world.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Whether light passes through any material of the world (extinction_length()). Shaders leave transmission out if not.
[[nodiscard]] inline bool lets_light_through(const World& world) {
  return std::ranges::any_of(world.resource<SceneAssets>().materials,
                             [](const Material& material) { return extinction_length(material) > 0.0f; });
}

}  // namespace gloam
