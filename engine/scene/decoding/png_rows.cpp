// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/decoding/png_rows.h"

#include <cstdlib>
#include <cstring>
#include <vector>

#include "engine/core/assert.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// Filters of PNG (ISO/IEC 15948) § 9, one pixel at a time with its four channels in the lanes of a vector. A loop over
// single bytes took half of the time of decoding textures.

namespace gloam {
namespace {

enum class Filter : std::uint8_t { none, sub, up, average, paeth };

#if defined(__SSE2__)

/// Channels in the low bytes of 16-bit lanes. Differences need more than 8 bits, and without repacking the dependency
/// chain from pixel to pixel stays short.
using Pixel = __m128i;

inline Pixel load(const std::uint8_t* bytes) {
  std::int32_t word = 0;
  std::memcpy(&word, bytes, 4);
  return _mm_unpacklo_epi8(_mm_cvtsi32_si128(word), _mm_setzero_si128());
}

inline void store(std::uint8_t* bytes, Pixel pixel) {
  const std::int32_t word = _mm_cvtsi128_si32(_mm_packus_epi16(pixel, pixel));
  std::memcpy(bytes, &word, 4);
}

inline Pixel zero_pixel() { return _mm_setzero_si128(); }
inline Pixel opaque(Pixel pixel) { return _mm_or_si128(pixel, _mm_set_epi16(0, 0, 0, 0, 255, 0, 0, 0)); }
/// Adds modulo 256 in the low bytes; the high bytes stay 0.
inline Pixel add(Pixel a, Pixel b) { return _mm_add_epi8(a, b); }
inline Pixel average(Pixel a, Pixel b) { return _mm_srli_epi16(_mm_add_epi16(a, b), 1); }

inline __m128i absolute(__m128i v) { return _mm_max_epi16(v, _mm_sub_epi16(_mm_setzero_si128(), v)); }
inline __m128i select(__m128i mask, __m128i yes, __m128i no) {
  return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
}

inline Pixel paeth(Pixel a, Pixel b, Pixel c) {
  const __m128i to_a = _mm_sub_epi16(b, c);
  const __m128i to_b = _mm_sub_epi16(a, c);
  const __m128i pa = absolute(to_a);
  const __m128i pb = absolute(to_b);
  const __m128i pc = absolute(_mm_add_epi16(to_a, to_b));
  const __m128i least = _mm_min_epi16(pc, _mm_min_epi16(pa, pb));
  return select(_mm_cmpeq_epi16(least, pa), a, select(_mm_cmpeq_epi16(least, pb), b, c));
}

#else

struct Pixel {
  std::uint8_t lane[4];
};

Pixel load(const std::uint8_t* bytes) {
  Pixel pixel;
  std::memcpy(pixel.lane, bytes, 4);
  return pixel;
}

void store(std::uint8_t* bytes, Pixel pixel) { std::memcpy(bytes, pixel.lane, 4); }
Pixel zero_pixel() { return {}; }
Pixel opaque(Pixel pixel) {
  pixel.lane[3] = 255;
  return pixel;
}

Pixel add(Pixel a, Pixel b) {
  for (int i = 0; i < 4; ++i) a.lane[i] = static_cast<std::uint8_t>(a.lane[i] + b.lane[i]);
  return a;
}

Pixel average(Pixel a, Pixel b) {
  for (int i = 0; i < 4; ++i) a.lane[i] = static_cast<std::uint8_t>((a.lane[i] + b.lane[i]) / 2);
  return a;
}

Pixel paeth(Pixel left, Pixel above, Pixel corner) {
  for (int i = 0; i < 4; ++i) {
    const int a = left.lane[i];
    const int b = above.lane[i];
    const int c = corner.lane[i];
    const int pa = std::abs(b - c);
    const int pb = std::abs(a - c);
    const int pc = std::abs(a + b - 2 * c);
    left.lane[i] = static_cast<std::uint8_t>(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
  }
  return left;
}

#endif

/// The value that the filter adds to a pixel.
template <Filter kFilter>
Pixel prediction(Pixel left, Pixel above, Pixel corner) {
  if constexpr (kFilter == Filter::sub) return left;
  if constexpr (kFilter == Filter::up) return above;
  if constexpr (kFilter == Filter::average) return average(left, above);
  if constexpr (kFilter == Filter::paeth) return paeth(left, above, corner);
  return zero_pixel();
}

/// For RGB the fourth lane holds a byte of the next pixel and a meaningless result, which `opaque` overwrites.
template <std::uint32_t kChannels, Filter kFilter>
void unfilter_row(const std::uint8_t* row, std::uint32_t width, const std::uint8_t* above_row, std::uint8_t* out) {
  Pixel left = zero_pixel();
  Pixel corner = zero_pixel();
  for (std::uint32_t x = 0; x < width; ++x) {
    const Pixel above = load(above_row + std::size_t{x} * 4);
    left = add(load(row + std::size_t{x} * kChannels), prediction<kFilter>(left, above, corner));
    corner = above;
    store(out + std::size_t{x} * 4, kChannels == 3 ? opaque(left) : left);
  }
}

template <std::uint32_t kChannels>
bool unfilter_rows(const std::uint8_t* rows, std::uint32_t width, std::uint32_t height, std::uint8_t* rgba) {
  const std::vector<std::uint8_t> nothing(std::size_t{width} * 4);
  const std::uint8_t* above = nothing.data();
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint8_t* row = rows + 1;
    switch (static_cast<Filter>(rows[0])) {
      case Filter::none:
        unfilter_row<kChannels, Filter::none>(row, width, above, rgba);
        break;
      case Filter::sub:
        unfilter_row<kChannels, Filter::sub>(row, width, above, rgba);
        break;
      case Filter::up:
        unfilter_row<kChannels, Filter::up>(row, width, above, rgba);
        break;
      case Filter::average:
        unfilter_row<kChannels, Filter::average>(row, width, above, rgba);
        break;
      case Filter::paeth:
        unfilter_row<kChannels, Filter::paeth>(row, width, above, rgba);
        break;
      default:
        return false;
    }
    above = rgba;
    rgba += std::size_t{width} * 4;
    rows += 1 + std::size_t{width} * kChannels;
  }
  return true;
}

}  // namespace

bool unfilter_png_rows(std::span<const std::uint8_t> rows, std::uint32_t width, std::uint32_t height,
                       std::uint32_t channels, std::span<std::uint8_t> rgba) {
  GLOAM_ASSERT(channels == 3 || channels == 4, "only RGB and RGBA rows are taken");
  GLOAM_ASSERT(rows.size() == (std::size_t{width} * channels + 1) * height + kPngRowPadding, "rows and padding");
  GLOAM_ASSERT(rgba.size() == std::size_t{width} * height * 4, "the output is the whole picture");
  if (channels == 3) return unfilter_rows<3>(rows.data(), width, height, rgba.data());
  return unfilter_rows<4>(rows.data(), width, height, rgba.data());
}

}  // namespace gloam
