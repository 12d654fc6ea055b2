// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/image_file.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/decoding/jpeg_segments.h"
#include "engine/scene/decoding/png_rows.h"
#include "engine/scene/decoding/webp_file.h"
#include "engine/scene/scene_path.h"

// Zeroed memory: stb_image 2.27 reads tables that a damaged JPEG does not define.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace gloam {
namespace {

Error fault(std::string sentence) { return {ErrorKind::input, std::move(sentence)}; }

bool is_png(std::span<const std::uint8_t> file) {
  constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  return file.size() > kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), file.begin());
}

bool is_jpeg(std::span<const std::uint8_t> file) {
  return file.size() > 3 && file[0] == 0xff && file[1] == 0xd8 && file[2] == 0xff;
}

/// Bits per pixel of a PNG before compression. Depth and colour type are at fixed places in its header.
std::uint64_t png_bits_per_pixel(std::span<const std::uint8_t> file) {
  constexpr std::array<std::uint64_t, 7> kChannels = {1, 1, 3, 1, 2, 1, 4};
  if (file.size() < 26 || file[25] >= kChannels.size()) return 1;
  return kChannels[file[25]] * std::max<std::uint64_t>(file[24], 1);
}

/// Whether the file is large enough for its stated size. Deflate shrinks to 1/1032 at best; a progressive JPEG spends
/// 0.75 byte on 256 flat pixels.
bool can_hold(std::span<const std::uint8_t> file, const ImageSize& size) {
  if (is_png(file)) return size.pixels() * png_bits_per_pixel(file) / 8 <= 1040 * std::uint64_t{file.size()};
  return size.pixels() <= 400 * std::uint64_t{file.size()};
}

std::uint32_t big_endian_word(std::span<const std::uint8_t> file, std::size_t at) {
  return std::uint32_t{file[at]} << 24 | std::uint32_t{file[at + 1]} << 16 | std::uint32_t{file[at + 2]} << 8 |
         file[at + 3];
}

/// The compressed rows of a PNG that needs nothing but inflating and unfiltering: 8-bit RGB or RGBA, not interlaced,
/// without a transparent colour. Empty for any other PNG, and if its chunks do not add up.
std::vector<std::uint8_t> plain_png_data(std::span<const std::uint8_t> file) {
  constexpr std::size_t kFirstChunk = 8;
  constexpr std::size_t kChunkFrame = 12;  // length, type, checksum
  std::vector<std::uint8_t> data;
  data.reserve(file.size());
  std::size_t at = kFirstChunk;
  while (at + kChunkFrame <= file.size()) {
    const std::size_t length = big_endian_word(file, at);
    if (length > file.size() - at - kChunkFrame) return {};
    const std::string_view type(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
    const std::span<const std::uint8_t> body = file.subspan(at + 8, length);
    if (at == kFirstChunk) {
      const bool plain = type == "IHDR" && length == 13 && body[8] == 8 && (body[9] == 2 || body[9] == 6) &&
                         body[10] == 0 && body[11] == 0 && body[12] == 0;
      if (!plain) return {};
    } else if (type == "IDAT") {
      data.insert(data.end(), body.begin(), body.end());
    } else if (type == "IEND") {
      return data;
    } else if (type == "tRNS" || (type[0] >= 'A' && type[0] <= 'Z' && type != "PLTE")) {
      return {};
    }
    at += kChunkFrame + length;
  }
  return {};
}

/// Why stb_image must not walk over these chunks of a PNG; empty: it may. It writes the name of an unknown critical
/// chunk into memory that threads share, also unprintable bytes, and takes the end of the file for such a chunk.
std::string_view png_chunk_fault(std::span<const std::uint8_t> file) {
  constexpr std::size_t kFrame = 12;  // length, type, checksum
  std::size_t at = 8;
  while (at + 8 <= file.size()) {
    const std::string_view type(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
    if (type == "IEND") return {};
    const bool critical = (file[at + 4] & 0x20) == 0;
    if (critical && type != "IHDR" && type != "PLTE" && type != "IDAT" && type != "CgBI")
      return "it has an unknown critical chunk";
    at += kFrame + big_endian_word(file, at);
  }
  return "it ends before its last chunk";
}

/// Inflates a zlib stream. False if it is damaged or does not give exactly bytes.size() bytes.
bool inflate(std::span<const std::uint8_t> data, std::span<std::uint8_t> bytes) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (decompressor == nullptr) throw std::bad_alloc();
  // With nullptr for the actual size, libdeflate fails unless the stream fills the buffer exactly.
  return libdeflate_zlib_decompress(decompressor.get(), data.data(), data.size(), bytes.data(), bytes.size(),
                                    nullptr) == LIBDEFLATE_SUCCESS;
}

/// Decodes the PNGs of most textures four times as fast as stb_image. False if this PNG needs stb_image.
bool decode_plain_png(std::span<const std::uint8_t> file, Image& image) {
  const std::vector<std::uint8_t> data = plain_png_data(file);
  if (data.empty()) return false;
  const std::uint32_t channels = file[25] == 2 ? 3 : 4;
  const std::size_t size = (std::size_t{image.width} * channels + 1) * image.height;
  const auto rows = std::make_unique_for_overwrite<std::uint8_t[]>(size + kPngRowPadding);
  std::fill_n(rows.get() + size, kPngRowPadding, std::uint8_t{0});
  if (!inflate(data, {rows.get(), size})) return false;
  return unfilter_png_rows({rows.get(), size + kPngRowPadding}, image.width, image.height, channels, image.rgba);
}

}  // namespace

Result<ImageSize> image_size(std::span<const std::uint8_t> file) {
  if (!is_png(file) && !is_jpeg(file) && !is_webp(file)) return fault("is not a PNG, JPEG or WebP image");
  if (file.size() > INT_MAX) return fault("is an image file of more than 2 GiB");
  if (is_webp(file)) {  // can_hold() does not apply: a flat image of any size takes less than 100 bytes
    const Result<WebpSize> webp = webp_size(file);
    if (!webp) return webp.error();
    return ImageSize{webp->width, webp->height, 1};
  }
  // Before stb_image sees the file: it reads tables that come before the header.
  const Result<std::uint32_t> scans = is_jpeg(file) ? count_jpeg_scans(file) : Result<std::uint32_t>(1u);
  if (!scans) return scans.error();
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels) == 0 || width < 1 ||
      height < 1)
    return fault("is not an image that can be read (its header is damaged or over 16384 pixels a side)");
  const ImageSize size{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), *scans};
  if (size.width > kMaxImageSide || size.height > kMaxImageSide)
    return fault("is " + std::to_string(width) + "×" + std::to_string(height) + " pixels, more than 16384 a side");
  if (!can_hold(file, size))
    return fault("says it is " + std::to_string(width) + "×" + std::to_string(height) +
                 " pixels, more than its bytes can hold");
  if (size.work() > decoding_work_limit(file.size()))
    return fault("has " + std::to_string(size.scans) + " scans of " + std::to_string(width) + "×" +
                 std::to_string(height) + " pixels, more work than its bytes justify");
  return size;
}

Result<Image> decode_image(std::span<const std::uint8_t> file) {
  const Result<ImageSize> size = image_size(file);
  if (!size) return size.error();
  Image image;
  image.width = size->width;
  image.height = size->height;
  image.rgba.resize(std::size_t{image.width} * image.height * 4);
  if (is_webp(file)) {
    if (decode_webp(file, {image.width, image.height}, image.rgba)) return image;
    return fault("is a damaged image (its WebP data end early or are wrong)");
  }
  if (is_png(file) && decode_plain_png(file, image)) return image;
  if (const std::string_view damage = is_png(file) ? png_chunk_fault(file) : std::string_view(); !damage.empty())
    return fault("is a damaged image (" + std::string(damage) + ")");
  int width = 0;
  int height = 0;
  int channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels, 4),
      &stbi_image_free);
  if (!pixels) return fault(std::string("is a damaged image (") + stbi_failure_reason() + ")");
  std::memcpy(image.rgba.data(), pixels.get(), image.rgba.size());
  return image;
}

Result<Image> read_image_file(const std::string& path) {
  const Result<std::vector<std::uint8_t>> bytes = read_scene_file(path);
  if (!bytes) return bytes.error();
  return decode_image(*bytes);
}

}  // namespace gloam
