// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/math/types.h"
#include "modules/depth_of_field/reference/blur_run.h"

namespace gloam {

/// The light after the module: its passes in double precision for every texel, without tiles and lists. Images are
/// rounded to half floats where the passes store them.
[[nodiscard]] std::vector<dvec4> dof_twin_light(const DofInput& in);

}  // namespace gloam
