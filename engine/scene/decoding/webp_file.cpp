// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/webp_file.h"

#include <webp/decode.h>

#include <cstddef>
#include <string_view>

#include "engine/core/assert.h"

namespace gloam {

bool is_webp(std::span<const std::uint8_t> file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  return text.size() > 12 && text.starts_with("RIFF") && text.substr(8, 4) == "WEBP";
}

Result<WebpSize> webp_size(std::span<const std::uint8_t> file) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(file.data(), file.size(), &features) != VP8_STATUS_OK || features.width < 1 ||
      features.height < 1)
    return Error{ErrorKind::input, "is not an image that can be read (its header is damaged)"};
  if (features.has_animation != 0)
    return Error{ErrorKind::input, "is an animated WebP image, only still images are read"};
  return WebpSize{static_cast<std::uint32_t>(features.width), static_cast<std::uint32_t>(features.height)};
}

bool decode_webp(std::span<const std::uint8_t> file, const WebpSize& size, std::span<std::uint8_t> rgba) {
  GLOAM_ASSERT(rgba.size() == std::size_t{size.width} * size.height * 4, "the output is the whole picture");
  return WebPDecodeRGBAInto(file.data(), file.size(), rgba.data(), rgba.size(), static_cast<int>(size.width) * 4) !=
         nullptr;
}

}  // namespace gloam
