// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/world.h"
#include "engine/scene/gltf_import.h"

namespace gloam {

inline constexpr int kCloseupFigures = 8;  ///< of builtin:closeups, all of them close-up subjects
inline constexpr int kCloseupLamps = 8;    ///< that reach every one of them

/// Eight figures of simple shapes in a yard under eight lamps and spots and a moon; each of them is a close-up subject.
void build_closeups_scene(World& world, SceneInfo& info);

/// Turns all but the first `count` figures into things that are no close-up subjects.
void keep_closeup_figures(World& world, int count);

}  // namespace gloam
