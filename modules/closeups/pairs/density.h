// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/render/view.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// The surface around the middle of a pixel.
struct PixelFootprint {
  dvec3 position = dvec3(0.0);  ///< camera-relative
  dvec3 right = dvec3(0.0);     ///< how far it goes on in its plane to the next pixel to the right
  dvec3 down = dvec3(0.0);
};

/// Of a pixel that shows a surface at `depth` (reversed, > 0) that faces along `normal`.
[[nodiscard]] PixelFootprint pixel_footprint(const RenderView& view, std::uint32_t x, std::uint32_t y, float depth,
                                             const dvec3& normal);

/// Texels of a face's map that a side of the pixel covers: the root of the number that the pixel covers. Nothing for a
/// surface outside the face's frustum. As shaders/closeups/closeup_texels_view.frag.glsl.
[[nodiscard]] std::optional<double> texels_per_pixel(const ShadowFace& face, const RenderView& view,
                                                     const PixelFootprint& footprint);

}  // namespace gloam
