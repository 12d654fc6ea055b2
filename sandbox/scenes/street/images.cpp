// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/street/images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "engine/math/types.h"

namespace gloam {
namespace {

/// color: sRGB of the point (u, v), each 0…1, v downwards.
Image painted_image(const char* name, std::uint32_t width, std::uint32_t height,
                    const std::function<vec3(float u, float v)>& color) {
  Image image{.name = name, .width = width, .height = height, .rgba = {}};
  image.rgba.reserve(std::size_t{4} * width * height);
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const vec3 c = color((static_cast<float>(column) + 0.5f) / static_cast<float>(width),
                           (static_cast<float>(row) + 0.5f) / static_cast<float>(height));
      for (int i = 0; i < 3; ++i)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(c[i], 0.0f, 1.0f) * 255.0f)));
      image.rgba.push_back(255);
    }
  }
  return image;
}

/// A number in 0…1 for a pair of numbers, always the same.
float scatter(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  h = (h ^ h >> 13) * 0x297a2d39u;
  return static_cast<float>((h ^ h >> 16) & 0xffffu) / 65535.0f;
}

/// 1 at 0, falling to 0 at ±width.
float bump(float x, float width) {
  const float t = std::clamp(1.0f - std::abs(x) / width, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

/// Letters of 5×7 dots; bit 4 of a row is the leftmost dot.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;
};
constexpr Glyph kGlyphs[] = {
    {'A', {0x0e, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}}, {'B', {0x1e, 0x11, 0x11, 0x1e, 0x11, 0x11, 0x1e}},
    {'C', {0x0e, 0x11, 0x10, 0x10, 0x10, 0x11, 0x0e}}, {'D', {0x1e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1e}},
    {'E', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x1f}}, {'F', {0x1f, 0x10, 0x10, 0x1e, 0x10, 0x10, 0x10}},
    {'H', {0x11, 0x11, 0x11, 0x1f, 0x11, 0x11, 0x11}}, {'I', {0x0e, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'K', {0x11, 0x12, 0x14, 0x18, 0x14, 0x12, 0x11}}, {'L', {0x10, 0x10, 0x10, 0x10, 0x10, 0x10, 0x1f}},
    {'M', {0x11, 0x1b, 0x15, 0x15, 0x11, 0x11, 0x11}}, {'N', {0x11, 0x19, 0x15, 0x13, 0x11, 0x11, 0x11}},
    {'O', {0x0e, 0x11, 0x11, 0x11, 0x11, 0x11, 0x0e}}, {'P', {0x1e, 0x11, 0x11, 0x1e, 0x10, 0x10, 0x10}},
    {'R', {0x1e, 0x11, 0x11, 0x1e, 0x14, 0x12, 0x11}}, {'S', {0x0f, 0x10, 0x10, 0x0e, 0x01, 0x01, 0x1e}},
    {'T', {0x1f, 0x04, 0x04, 0x04, 0x04, 0x04, 0x04}}, {'W', {0x11, 0x11, 0x11, 0x15, 0x15, 0x1b, 0x11}},
    {'Y', {0x11, 0x11, 0x0a, 0x04, 0x04, 0x04, 0x04}},
};

bool has_dot(char letter, int column, int row) {
  for (const Glyph& glyph : kGlyphs)
    if (glyph.letter == letter) return (glyph.rows[static_cast<std::size_t>(row)] >> (4 - column) & 1) != 0;
  return false;
}

}  // namespace

Image shelves_image() {
  return painted_image("shelves", 96, 64, [](float u, float v) {
    const float strip = 0.55f + 0.45f * bump(v - 0.06f, 0.5f);
    const float shelf = std::fmod(v + 0.72f, 0.29f) / 0.29f;  // 0 at a shelf's top, 1 at its board
    const auto row = static_cast<std::uint32_t>((v + 0.72f) / 0.29f);
    const auto item = static_cast<std::uint32_t>(u * 23.0f);
    const float height = 0.25f + 0.55f * scatter(item, row);
    const float in_item = u * 23.0f - static_cast<float>(item);
    if (v > 0.2f && shelf > 0.92f) return vec3(0.2f, 0.14f, 0.1f);
    const bool is_item = v > 0.2f && 1.0f - shelf < height && in_item > 0.08f && scatter(item, row + 9) > 0.2f;
    if (!is_item) return vec3(1.0f, 0.95f, 0.86f) * strip;
    const vec3 tint(0.35f + 0.6f * scatter(item, row + 20), 0.3f + 0.45f * scatter(item, row + 30),
                    0.22f + 0.4f * scatter(item, row + 40));
    return tint * (0.45f + 0.4f * strip);
  });
}

Image guests_image() {
  return painted_image("guests", 96, 64, [](float u, float v) {
    float light = 0.5f + 0.12f * std::cos(u * 40.0f) * (v < 0.62f ? 1.0f : 0.0f);
    for (const float lamp : {0.18f, 0.5f, 0.82f}) {
      const float distance = std::hypot((u - lamp) * 1.5f, v - 0.24f);
      if (distance < 0.05f) return vec3(1.0f);
      light += 0.5f * bump(distance, 0.4f);
      if (std::abs(u - lamp) < 0.006f && v < 0.2f) return vec3(0.2f);
    }
    for (const float guest : {0.1f, 0.3f, 0.42f, 0.66f, 0.9f}) {
      const float head = std::hypot((u - guest) * 1.5f, v - 0.55f - 0.1f * guest);
      const bool is_body = v > 0.64f + 0.1f * guest && std::abs(u - guest) < 0.05f;
      if (head < 0.06f || is_body) return vec3(0.22f, 0.16f, 0.14f);
    }
    if (v > 0.86f) return vec3(0.3f, 0.2f, 0.14f);
    return vec3(1.0f, 0.92f, 0.8f) * std::min(light, 1.0f);
  });
}

Image curtains_image() {
  return painted_image("curtains", 48, 64, [](float u, float v) {
    const float middle = std::abs(u - 0.5f) * 2.0f;  // 0 in the middle, 1 at the sides
    const float opening = 0.42f + 0.3f * v * v;      // the curtains are drawn together at the top
    if (middle > opening) return vec3(0.82f, 0.66f, 0.5f) * (0.62f + 0.2f * std::sin(u * 75.0f));
    if (v > 0.8f && bump(u - 0.55f, 0.2f) > (0.95f - v) * 5.0f) return vec3(0.25f, 0.24f, 0.16f);  // a plant
    return vec3(1.0f, 0.94f, 0.84f) * (0.68f + 0.32f * bump(std::hypot(u - 0.5f, v - 0.3f), 0.6f));
  });
}

Image sign_image(std::string_view word) {
  constexpr float kDotsWide = 44.0f, kDotsHigh = 11.0f;
  const std::string name = "sign " + std::string(word);
  const float first = 0.5f * (kDotsWide - static_cast<float>(word.size()) * 6.0f + 1.0f);
  return painted_image(name.c_str(), 176, 44, [&](float u, float v) {
    const auto column = static_cast<int>(std::floor(u * kDotsWide - first));
    const auto row = static_cast<int>(std::floor(v * kDotsHigh - 2.0f));
    const bool is_letter = column >= 0 && row >= 0 && row < 7 && column < static_cast<int>(word.size()) * 6 &&
                           column % 6 < 5 && has_dot(word[static_cast<std::size_t>(column) / 6], column % 6, row);
    return is_letter ? vec3(1.0f) : vec3(0.2f);
  });
}

}  // namespace gloam
