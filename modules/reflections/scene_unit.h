// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"

namespace gloam {

/// A metre in units of the scene (SceneUnits): what constants of reflections are multiples of. They say how thick
/// things are that screen space sees from the front only, how far its rays go, how far before a proxy its capture
/// begins, and cannot be known from a picture.
[[nodiscard]] double scene_unit(const World& world);

}  // namespace gloam
