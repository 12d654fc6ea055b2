// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/views/read_picture.h"

#include <cstring>
#include <string>

#include "engine/math/packing.h"
#include "engine/render/readback/capture.h"

namespace gloam {
namespace {

Error without_images(ViewId view, const char* needed) {
  return {ErrorKind::usage,
          "view " + std::to_string(view.value) + ": " + needed + "; its images may have been released"};
}

/// An error unless a frame that was not given up has drawn the view's images.
Status check_drawn(const ViewImages& images) {
  if (images.drawn) return {};
  return Error{ErrorKind::failed, "the view has no picture yet: its frames were given up"};
}

Result<std::vector<std::byte>> read_after_all_frames(gpu::Device& device, gpu::ImageHandle image) {
  GLOAM_TRY(device.wait_idle());
  return read_image_now(device, image);
}

}  // namespace

Result<Picture> read_picture(const ViewStore& views, ViewId view, gpu::Device& device) {
  const ViewImages* images = views.find(view);
  if (images == nullptr || !images->picture)
    return without_images(view, "read_picture needs a view that was rendered without a target");
  GLOAM_TRY(check_drawn(*images));
  const auto bytes = read_after_all_frames(device, images->picture);
  if (!bytes.ok()) return bytes.error();
  Picture picture{images->picture_size.x, images->picture_size.y, {}};
  picture.rgba.resize(bytes->size());
  std::memcpy(picture.rgba.data(), bytes->data(), bytes->size());
  return picture;
}

Result<LinearPicture> read_linear(const ViewStore& views, ViewId view, gpu::Device& device) {
  const ViewImages* images = views.find(view);
  if (images == nullptr || !images->lit) return without_images(view, "read_linear needs a view that was rendered");
  GLOAM_TRY(check_drawn(*images));
  GLOAM_ASSERT(images->lit_is_last, "view " + std::to_string(view.value) +
                                        ": read_linear needs a frame drawn with ViewRequest::keep_linear");
  const auto bytes = read_after_all_frames(device, images->lit);
  if (!bytes.ok()) return bytes.error();
  LinearPicture picture{images->width, images->height, {}};
  picture.rgba.resize(bytes->size() / sizeof(std::uint16_t));
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
    std::uint16_t half = 0;
    std::memcpy(&half, bytes->data() + i * sizeof(half), sizeof(half));
    picture.rgba[i] = half_to_float(half) / (i % 4 == 3 ? 1.0f : images->light_scale);
  }
  return picture;
}

}  // namespace gloam
