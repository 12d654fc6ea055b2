// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// The surface that one pixel sees, around the pixel's centre.
struct PixelFootprint {
  dvec3 position = dvec3(0.0);  ///< camera-relative
  dvec3 right = dvec3(0.0);     ///< offset in the surface's plane to the next pixel on the right
  dvec3 down = dvec3(0.0);
};

/// The footprint of a pixel that shows a surface with face normal `normal` at `depth` (reversed Z, > 0).
[[nodiscard]] PixelFootprint pixel_footprint(const RenderView& view, std::uint32_t x, std::uint32_t y, float depth,
                                             const dvec3& normal);

/// Texels of a face per pixel side: the square root of the number of texels that the pixel covers. None for a surface
/// outside the face's frustum. Same as in shaders/closeups/closeup_texels_view.frag.glsl.
[[nodiscard]] std::optional<double> texels_per_pixel(const ShadowFace& face, const RenderView& view,
                                                     const PixelFootprint& footprint);

}  // namespace gloam
