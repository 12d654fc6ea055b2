// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/keys/registry.h"

namespace gloam {

/// Scene keys of grass, colliders and wind. A file of blade types that is missing or wrong is an error of the import.
void add_grass_keys(KeyRegistry& registry);

}  // namespace gloam
