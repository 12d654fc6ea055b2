// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/schedule/schedule.h"

namespace gloam {

/// Adds animation, transform, joint-matrix and morph systems (module "engine", world stage), in that order.
void add_scene_systems(Schedule& schedule);

}  // namespace gloam
