// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/ecs/world.h"

namespace gloam {

/// Hexadecimal hash of a loaded scene: of its file, and of the world's meshes, images and animation clips, which may
/// come from other files. For a built-in scene, its name is hashed instead of a file.
[[nodiscard]] std::string scene_hash(const std::string& scene, const World& world);

/// Hexadecimal hash of the program's executable file, to tell measurements of different builds apart. Empty if
/// /proc/self/exe cannot be read.
[[nodiscard]] std::string program_hash();

}  // namespace gloam
