// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "engine/render/readback/picture.h"

namespace gloam {

/// Light of a view that a reference has computed, to be shown in place of the frame's own light. Modules derive a world
/// resource of their own from it. rgba half floats, rows from the top.
struct LightPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint16_t> light;

  [[nodiscard]] bool fits(const RenderView& view) const { return width == view.width && height == view.height; }
};

/// The picture in half floats, as a view with this RenderView::light_scale stores it; light above 65504 becomes 65504.
[[nodiscard]] LightPicture to_light_picture(const LinearPicture& picture, float light_scale);

/// The picture as an image of the view's size, which it must have. pass: name of the pass and of the image. Null if the
/// frame was given up.
[[nodiscard]] ImageRef upload_light_picture(FrameBuilder& frame, Staging& staging, const std::string& pass,
                                            const LightPicture& picture);

/// PassPhase::post: LitOutput becomes the picture, which must fit the view. pass: as above.
void add_light_picture_pass(FrameBuilder& frame, Staging& staging, const std::string& pass,
                            const LightPicture& picture);

}  // namespace gloam
