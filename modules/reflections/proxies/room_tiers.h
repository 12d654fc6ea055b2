// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/reflections/knobs.h"

namespace gloam {

/// The knobs without the tiers that the camera's smallest room leaves out (IbrRoom::tiers). For views whose ProxyTiles
/// are up to date.
[[nodiscard]] ReflectionKnobs in_room(ReflectionKnobs knobs, const World& world, ViewId view);

}  // namespace gloam
