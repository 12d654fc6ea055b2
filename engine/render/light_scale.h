// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/resources.h"

namespace gloam {

/// The greatest half float that is not infinite.
inline constexpr double kMostHalf = 65504.0;

/// Factor from cd/m² and lux to the light in a view's half-float images (RenderView::light_scale): a power of two, so
/// that scaled light has the same bits of mantissa. It is 1 if white, 1.2 · 2^EV cd/m², is from 1/4 to 256. Otherwise
/// it brings white to the nearer end of that range: light of 255 times white does not overflow, and the darkest step of
/// a picture is a normal number.
[[nodiscard]] float light_scale(const SceneEnvironment& environment);

}  // namespace gloam
