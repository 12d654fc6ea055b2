// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

inline constexpr int kCloseupFigures = 8;  ///< figures in builtin:closeups, each a close-up subject
inline constexpr int kCloseupLamps = 8;    ///< point and spot lights in builtin:closeups; each reaches every figure

/// Shows close-up shadows: eight figures of simple shapes in a yard, lit by eight point and spot lights and a moon.
/// Each figure is a close-up subject. Cameras "main" and "face".
void build_closeups_scene(World& world, SceneInfo& info);

/// Disables CloseupSubject for all figures but the first `count`.
void keep_closeup_figures(World& world, int count);

}  // namespace gloam
