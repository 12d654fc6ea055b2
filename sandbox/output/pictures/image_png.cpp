// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <zlib.h>

#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>
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

constexpr std::string_view kLegendKey("gloam legend rows\0", 18);  // keyword of a tEXt chunk
constexpr std::size_t kAfterHeader = 8 + 25;                       // signature and IHDR chunk

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 255u);
}

/// A text chunk: length, type, text, checksum of type and text.
std::string text_chunk(const std::string& text) {
  const std::string body = "tEXt" + text;
  std::string chunk;
  append_word(chunk, static_cast<std::uint32_t>(text.size()));
  chunk += body;
  append_word(chunk, static_cast<std::uint32_t>(
                         crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
  return chunk;
}

}  // namespace

Status write_png(const std::string& path, std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba,
                 std::uint32_t legend_rows) {
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
  if (legend_rows > 0) file.insert(kAfterHeader, text_chunk(std::string(kLegendKey) + std::to_string(legend_rows)));
  return write_file(path, file);
}

std::uint32_t legend_rows_of(std::span<const std::uint8_t> file) {
  const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
  constexpr std::size_t kText = kAfterHeader + 8;
  if (bytes.size() < kText || bytes.substr(kAfterHeader + 4, 4) != "tEXt") return 0;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) length = length << 8 | file[kAfterHeader + i];
  const std::string_view text = bytes.substr(kText, length);
  std::uint32_t rows = 0;
  if (text.starts_with(kLegendKey)) std::from_chars(text.data() + kLegendKey.size(), text.data() + text.size(), rows);
  return rows;
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
