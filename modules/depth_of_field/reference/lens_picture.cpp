// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/lens_picture.h"

#include <cstring>
#include <span>

namespace gloam {

const LensPicture* find_lens_picture(const World& world, const RenderView& view) {
  const auto* picture = world.try_resource<LensPicture>();
  return picture != nullptr && picture->width == view.width && picture->height == view.height ? picture : nullptr;
}

void add_lens_picture_pass(FrameBuilder& frame, Staging& staging, const LensPicture& picture) {
  const auto texels = std::as_bytes(std::span(picture.light));
  const auto slice = staging.ring(frame.services().device).allocate(texels.size());
  if (!frame.check(slice)) return;
  std::memcpy(slice->bytes.data(), texels.data(), texels.size());
  PassBuilder pass = frame.graph().add_pass("dof_lens_picture", frame.module());
  const ImageRef written =
      pass.write(create_view_image(frame, "dof_lens_picture", gpu::Format::rgba16_float), gpu::Access::transfer_write);
  pass.execute([written, source = *slice](PassContext& context) {
    context.commands().copy_buffer_to_image(source.buffer, source.offset, context.image(written), 0, 0, 1);
  });
  frame.get<LitOutput>().color = written;
}

}  // namespace gloam
