// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "modules/depth_of_field/components.h"
#include "modules/depth_of_field/knobs.h"
#include "shaders/depth_of_field/depth_of_field_shared.h"

namespace gloam {

/// The aperture's shape as the kernels measure it, and their radii (kernel_api.glsl).
[[nodiscard]] double dof_kernel_radius(Bokeh bokeh, double circle_px, int level);
/// The greatest square of the distance of a texel that has a weight in a kernel.
[[nodiscard]] int dof_texels(Bokeh bokeh, double kernel_radius);

/// Sets the members that follow from the size of the picture, the knobs and the bokeh: all but the circle's.
/// Returns the size of an image of all levels.
///
/// Circles grow with the height of the picture, and so does their limit: dof.radius ÷ 360 of it. A level has the
/// circles whose radius is one to two of its texels (half resolution), so kernels have few texels, and circles beyond
/// the limit go to coarser levels. They stop at four times the limit.
uvec2 set_dof_levels(const uvec2& size, const DofKnobs& knobs, Bokeh bokeh, shaders::DofConstants& constants);

}  // namespace gloam
