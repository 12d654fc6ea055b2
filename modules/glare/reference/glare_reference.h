// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/reference/light_picture.h"
#include "engine/render/reference/reference.h"

namespace gloam {

/// World resource: light of a view that its lens has spread (ScatteredLight), in place of what the passes would spread.
struct GlarePicture : LightPicture {};

/// The world's glare picture, if it has one of the view's size; else null.
[[nodiscard]] inline const GlarePicture* find_glare_picture(const World& world, const RenderView& view) {
  const auto* picture = world.try_resource<GlarePicture>();
  return picture != nullptr && picture->fits(view) ? picture : nullptr;
}

/// Convolves the frame's light in double precision and puts the result into the world, for the frame that shows it.
/// Usage error if the frame cannot be drawn again.
[[nodiscard]] Status put_glare_picture(World& world, const ReferenceInput& input);

/// The reference of glare.lines: the picture of the frame's light convolved in double precision.
[[nodiscard]] ReferenceInfo glare_reference();

}  // namespace gloam
