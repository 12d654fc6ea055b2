// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "modules/depth_of_field/components.h"

namespace gloam {

/// Point number `index` of a low-discrepancy sequence on the aperture, uniform in area. Radius 1 (a hexagon's: from its
/// centre to its corners, one of which is at +y).
[[nodiscard]] glm::dvec2 lens_point(Bokeh bokeh, std::uint32_t index);

}  // namespace gloam
