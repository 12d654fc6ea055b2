// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/support/webp_files.h"

#include <webp/encode.h>

#include <cstdlib>
#include <string_view>

namespace gloam::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

void put_number(Bytes& out, std::size_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void put_chunk(Bytes& out, std::string_view name, std::span<const std::uint8_t> content) {
  out.insert(out.end(), name.begin(), name.end());
  put_number(out, content.size(), 4);
  out.insert(out.end(), content.begin(), content.end());
  if (content.size() % 2 != 0) out.push_back(0);
}

}  // namespace

std::vector<std::uint8_t> encode_webp(int width, int height, std::span<const std::uint8_t> rgba, float quality) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigInit(&config) == 0 || WebPPictureInit(&picture) == 0) std::abort();
  config.quality = quality < 0.0f ? 75.0f : quality;
  config.lossless = quality < 0.0f ? 1 : 0;
  config.exact = 1;
  picture.use_argb = 1;
  picture.width = width;
  picture.height = height;
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = &WebPMemoryWrite;
  picture.custom_ptr = &writer;
  if (WebPPictureImportRGBA(&picture, rgba.data(), width * 4) == 0 || WebPEncode(&config, &picture) == 0) std::abort();
  Bytes file(writer.mem, writer.mem + writer.size);
  WebPMemoryWriterClear(&writer);
  WebPPictureFree(&picture);
  return file;
}

std::vector<std::uint8_t> animate_webp(int width, int height, std::span<const std::uint8_t> still) {
  const auto size = [width, height](Bytes& out) {
    put_number(out, static_cast<std::size_t>(width - 1), 3);
    put_number(out, static_cast<std::size_t>(height - 1), 3);
  };
  Bytes features = {2, 0, 0, 0};  // animation
  size(features);
  Bytes frame(6);  // at the corner
  size(frame);
  put_number(frame, 100, 3);  // milliseconds
  frame.push_back(0);
  frame.insert(frame.end(), still.begin() + 12, still.end());
  Bytes body = {'W', 'E', 'B', 'P'};
  put_chunk(body, "VP8X", features);
  put_chunk(body, "ANIM", Bytes(6));
  put_chunk(body, "ANMF", frame);
  Bytes file;
  put_chunk(file, "RIFF", body);
  return file;
}

}  // namespace gloam::test
