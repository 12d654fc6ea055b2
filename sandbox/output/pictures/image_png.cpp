// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <zlib.h>

#include <cstdlib>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"

namespace {

// Replaces stb's own deflate, which takes three times as long as zlib's fastest level and makes larger files.
unsigned char* compress_fast(unsigned char* data, int size, int* out_size, int /*quality*/) {
  uLongf bound = compressBound(static_cast<uLong>(size));
  auto* out = static_cast<unsigned char*>(std::malloc(bound));
  if (out == nullptr) return nullptr;
  if (compress2(out, &bound, data, static_cast<uLong>(size), Z_BEST_SPEED) != Z_OK) {
    std::free(out);
    return nullptr;
  }
  *out_size = static_cast<int>(bound);
  return out;
}

}  // namespace

#define STBIW_ZLIB_COMPRESS compress_fast
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace gloam {
namespace {

constexpr int kFilterUp = 2;  // one filter for all rows: choosing one per row costs more time than it saves

void append_bytes(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height,
                 std::span<const std::uint8_t> rgba) {
  const std::size_t pixels = std::size_t{width} * height;
  GLOAM_ASSERT(rgba.size() == pixels * 4 && pixels > 0, "a picture has four bytes a pixel");
  if (pixels > 0x7fffffff / 4) return Error{ErrorKind::failed, path + ": the picture is too large for a PNG"};
  std::vector<std::uint8_t> rgb(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) rgb[i * 3 + channel] = rgba[i * 4 + channel];
  }
  stbi_write_force_png_filter = kFilterUp;
  std::string file;
  const int row_bytes = static_cast<int>(width) * 3;
  if (stbi_write_png_to_func(append_bytes, &file, static_cast<int>(width), static_cast<int>(height), 3, rgb.data(),
                             row_bytes) == 0)
    return Error{ErrorKind::failed, path + ": the picture cannot be compressed: out of memory"};
  return write_file(path, file);
}

Result<std::string> jpeg_bytes(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                               int quality) {
  GLOAM_ASSERT(rgba.size() == std::size_t{width} * height * 4 && !rgba.empty(), "a picture has four bytes a pixel");
  std::string file;
  if (stbi_write_jpg_to_func(append_bytes, &file, static_cast<int>(width), static_cast<int>(height), 4, rgba.data(),
                             quality) == 0)
    return Error{ErrorKind::failed, "a picture cannot be written as JPEG"};
  return file;
}

}  // namespace gloam
