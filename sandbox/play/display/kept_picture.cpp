// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/kept_picture.h"

namespace gloam {

Status KeptPicture::declare(WindowPictures& pictures, Upscaler& upscaler,
                            const std::function<Status(FrameGraph&, ImageRef&)>& overlay) {
  const auto image = pictures.acquire();
  if (!image.ok()) return image.error();
  graph_.begin();
  if (*image) {
    ImageRef window = graph_.import_image("window", *image, gpu::Access::none, gpu::Access::present);
    const ImageRef picture = graph_.import_image("reduced_picture", upscaler.kept_image(), gpu::Access::fragment_read,
                                                 gpu::Access::fragment_read);
    GLOAM_TRY(upscaler.add_passes(graph_, picture, window));
    GLOAM_TRY(overlay(graph_, window));
  }
  return graph_.compile();
}

Status KeptPicture::draw(WindowPictures& pictures, Upscaler& upscaler,
                         const std::function<Status(FrameGraph&, ImageRef&)>& overlay) {
  auto commands = device_.begin_frame();
  if (!commands.ok()) return commands.error();
  if (const Status declared = declare(pictures, upscaler, overlay); !declared.ok()) {
    static_cast<void>(device_.abandon_frame());
    return declared;
  }
  graph_.execute(**commands);
  return device_.submit_frame();
}

}  // namespace gloam
