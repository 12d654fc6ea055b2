// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// Shows light through thin parts: a lamp and a low sun behind a paper screen, leaves, wax and balls of stone. A cross
/// between lamp and screen casts its shadow on the side of the paper that the camera sees. Cameras "main" and "leaves".
void build_backlight_scene(World& world, SceneInfo& info);

}  // namespace gloam
