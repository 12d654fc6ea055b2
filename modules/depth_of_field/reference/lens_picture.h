// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/render/reference/light_picture.h"

namespace gloam {

/// World resource: light of a view that takes the place of what the frame would show, so that the picture is made from
/// it.
struct LensPicture : LightPicture {};

/// The world's lens picture, if it has one of the view's size; else null.
[[nodiscard]] inline const LensPicture* find_lens_picture(const World& world, const RenderView& view) {
  const auto* picture = world.try_resource<LensPicture>();
  return picture != nullptr && picture->fits(view) ? picture : nullptr;
}

}  // namespace gloam
