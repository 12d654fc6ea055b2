// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/key_registry.h"

namespace gloam {

/// Registers KHR_lights_punctual, the gloam.light.* keys that shape light, and which nodes count as lights.
void add_light_keys(KeyRegistry& registry);

}  // namespace gloam
