// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/types.h"

namespace gloam {

/// The light of a picture convolved with glare_spread() in double precision: the integral of each Gaussian over each
/// pixel. Light that is not a number counts as none, and more than 65504 · most as that. light: rows from the top.
/// most: 1 / RenderView::light_scale.
[[nodiscard]] std::vector<dvec3> spread_light(const std::vector<vec4>& light, uvec2 size, JobExecutor& executor,
                                              double most = 65504.0);

}  // namespace gloam
