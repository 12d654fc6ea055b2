// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/keys/registry.h"

namespace gloam {

/// The module's scene keys.
void add_particle_keys(KeyRegistry& registry);

}  // namespace gloam
