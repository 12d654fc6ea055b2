// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/window_pictures.h"

namespace gloam {

Result<bool> WindowPictures::follow_window() {
  const std::uint32_t width = window_.width();
  const std::uint32_t height = window_.height();
  if (width == 0 || height == 0) return false;
  if (!fits_ || width != width_ || height != height_) {
    GLOAM_TRY(swapchain_.resize(width, height));
    width_ = width;
    height_ = height;
    fits_ = true;
  }
  return true;
}

Result<gpu::ImageHandle> WindowPictures::acquire() {
  auto image = swapchain_.acquire();
  fits_ = image.ok() && *image;
  return image;
}

Result<bool> WindowPictures::present() {
  GLOAM_TRY(swapchain_.present());
  return fits_;
}

}  // namespace gloam
