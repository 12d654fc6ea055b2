// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/reference/light_picture.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "engine/math/packing.h"

namespace gloam {

LightPicture to_light_picture(const LinearPicture& picture, float light_scale) {
  LightPicture half{picture.width, picture.height, {}};
  half.light.reserve(picture.rgba.size());
  for (std::size_t i = 0; i < picture.rgba.size(); ++i)
    half.light.push_back(float_to_half(std::min(picture.rgba[i] * (i % 4 == 3 ? 1.0f : light_scale), 65504.0f)));
  return half;
}

ImageRef upload_light_picture(FrameBuilder& frame, Staging& staging, const std::string& pass,
                              const LightPicture& picture) {
  const auto texels = std::as_bytes(std::span(picture.light));
  const auto slice = staging.ring(frame.services().device).allocate(texels.size());
  if (!frame.check(slice)) return {};
  std::memcpy(slice->bytes.data(), texels.data(), texels.size());
  PassBuilder upload = frame.graph().add_pass(pass, frame.module());
  const ImageRef written =
      upload.write(create_view_image(frame, pass, gpu::Format::rgba16_float), gpu::Access::transfer_write);
  upload.execute([written, source = *slice](PassContext& context) {
    context.commands().copy_buffer_to_image(source.buffer, source.offset, context.image(written), 0, 0, 1);
  });
  return written;
}

void add_light_picture_pass(FrameBuilder& frame, Staging& staging, const std::string& pass,
                            const LightPicture& picture) {
  const ImageRef written = upload_light_picture(frame, staging, pass, picture);
  if (written) frame.get<LitOutput>().color = written;
}

}  // namespace gloam
