// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/jobs/executor.h"
#include "modules/grass/growth/scatter.h"
#include "modules/grass/growth/surface.h"

namespace gloam {

/// Pushes each root away from its neighbours, `steps` times, along the surface: across the edges of connected triangles
/// but never beyond a border. All roots move at once, so the order of work has no effect.
void relax_roots(const GrowthSurface& surface, int steps, JobExecutor& jobs, std::span<ScatteredRoot> roots);

}  // namespace gloam
