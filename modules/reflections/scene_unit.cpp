// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/scene_unit.h"

#include "engine/scene/units.h"

namespace gloam {

double scene_unit(const World& world) { return 1.0 / metres_per_unit(world); }

}  // namespace gloam
