// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/frame/staging.h"
#include "engine/render/frame_builder.h"

namespace gloam {

/// World resource: light of a view that takes the place of what the frame would show, so that the picture is made from
/// it. rgba half floats, rows from the top.
struct LensPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> light;
};

/// The world's lens picture, if it has one of the view's size; else null.
[[nodiscard]] const LensPicture* find_lens_picture(const World& world, const RenderView& view);

/// PassPhase::post: LitOutput becomes the picture.
void add_lens_picture_pass(FrameBuilder& frame, Staging& staging, const LensPicture& picture);

}  // namespace gloam
