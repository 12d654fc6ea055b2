// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/ecs/world.h"

namespace gloam {

/// A sentence for each light that casts shadows and lies inside a mesh that casts into its maps, so that it lights
/// nothing outside of the mesh. A light is inside a mesh if the mesh fills almost all directions around it, in rest
/// pose. Bulbs (is_bulb()) and blended surfaces do not count. Ordered by the lights' entity index.
[[nodiscard]] std::vector<std::string> enclosed_lights(const World& world);

}  // namespace gloam
