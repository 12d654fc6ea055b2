// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/ecs/world.h"

namespace gloam {

/// Hash of what a loaded scene holds, hexadecimal: of its file, and of the geometry and images that files beside it
/// brought. Built-in scenes are told apart by their names and assets.
[[nodiscard]] std::string scene_hash(const std::string& scene, const World& world);

/// Hash of the running program's own file, hexadecimal; empty where the system does not tell. Measurements of another
/// build are others.
[[nodiscard]] std::string program_hash();

}  // namespace gloam
