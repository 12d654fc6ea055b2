// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/keys/registry.h"

namespace gloam {

/// Registers KHR_lights_punctual, the keys gloam.light.width, .angle and .cookie, and the test for nodes that are
/// lights.
void add_light_keys(KeyRegistry& registry);

}  // namespace gloam
