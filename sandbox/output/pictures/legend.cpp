// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/pictures/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "engine/math/srgb.h"
#include "engine/render/passes/visualizer_pass.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace gloam {
namespace {

constexpr int kLegendMargin = 4;
constexpr int kLineHeight = 12;  // pixels at scale 1
constexpr int kBarHeight = 8;
constexpr int kBarWidth = 240;

/// Vertex layout of stb_easy_font. Four vertices are a rectangle.
struct FontVertex {
  float x, y, z;
  std::uint8_t color[4];
};

int text_width(std::string text) { return stb_easy_font_width(text.data()); }

/// Wraps text at spaces into lines no wider than `width`. A wider word gets a separate line.
std::vector<std::string> wrapped(std::string_view text, int width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, space));
    text.remove_prefix(std::min(space + 1, text.size()));
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || text_width(longer) <= width)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

class Canvas {
 public:
  Canvas(Picture& picture, int scale) : picture_(picture), scale_(scale) {}

  void darken_below(int top) {
    for (std::size_t i = static_cast<std::size_t>(std::max(top, 0)) * picture_.width * 4; i < picture_.rgba.size(); ++i)
      if (i % 4 != 3) picture_.rgba[i] = static_cast<std::uint8_t>(picture_.rgba[i] / 4);
  }

  /// Colours from left to right. Sizes in pixels.
  void draw_bar(int left, int top, int width, int height) {
    for (int x = 0; x < width; ++x) {
      const vec3 color = heat_color((x + 0.5) / width);
      const auto channel = [&](float value) {
        return static_cast<std::uint8_t>(std::lround(255.0f * linear_to_srgb(value)));
      };
      fill(left + x, top, left + x + 1, top + height, {channel(color.r), channel(color.g), channel(color.b), 255});
    }
  }

  void draw_line(std::string text, int left, int top) {
    std::vector<FontVertex> vertices(text.size() * 4 * 20 + 4);
    const int rectangles = stb_easy_font_print(0.0f, 0.0f, text.data(), nullptr, vertices.data(),
                                               static_cast<int>(vertices.size() * sizeof(FontVertex)));
    for (int r = 0; r < rectangles; ++r) {
      const FontVertex& a = vertices[static_cast<std::size_t>(4 * r)];
      const FontVertex& c = vertices[static_cast<std::size_t>(4 * r + 2)];
      fill(left + scaled(a.x), top + scaled(a.y), left + scaled(c.x), top + scaled(c.y));
    }
  }

 private:
  [[nodiscard]] int scaled(float at) const { return static_cast<int>(std::lround(at)) * scale_; }

  void fill(int left, int top, int right, int bottom, std::array<std::uint8_t, 4> color = {255, 255, 255, 255}) {
    const int width = static_cast<int>(picture_.width), height = static_cast<int>(picture_.height);
    for (int y = std::max(top, 0); y < std::min(bottom, height); ++y)
      for (int x = std::max(left, 0); x < std::min(right, width); ++x)
        std::memcpy(&picture_.rgba[4 * (static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x))],
                    color.data(), color.size());
  }

  Picture& picture_;
  int scale_;
};

/// A bar with its values below it.
void draw_scale(Canvas& canvas, int top, int width, int scale, const HeatScale& heat, float heat_range) {
  canvas.draw_bar(scale * kLegendMargin, top, width, scale * (kBarHeight - 2));
  const int left = scale * kLegendMargin;
  for (const HeatTick& tick : heat_ticks(heat, heat_range)) {
    const int wide = scale * text_width(tick.text);
    const int middle = left + static_cast<int>(std::lround(width * tick.share));
    canvas.draw_line(tick.text, std::clamp(middle - wide / 2, left, std::max(left, left + width - wide)),
                     top + scale * kBarHeight);
  }
}

}  // namespace

std::uint32_t draw_legend(Picture& picture, std::string_view text, const HeatScale& heat, float heat_range) {
  if (text.empty() || picture.width < 64 || picture.height < 32) return 0;
  const int scale = picture.height >= 720 ? 2 : 1;
  const int room = static_cast<int>(picture.width) / scale - 2 * kLegendMargin;
  const std::vector<std::string> lines = wrapped(text, room);
  const bool has_bar = heat.most > 0.0 && picture.width >= 128 && picture.height >= 72;
  const int bar = has_bar ? scale * (kBarHeight + kLineHeight) : 0;
  const int top =
      static_cast<int>(picture.height) - scale * (static_cast<int>(lines.size()) * kLineHeight + kLegendMargin);
  Canvas canvas(picture, scale);
  const int strip = std::max(top - scale * kLegendMargin - bar, 0);
  canvas.darken_below(strip);
  if (has_bar) draw_scale(canvas, top - bar, std::min(scale * room, scale * kBarWidth), scale, heat, heat_range);
  for (std::size_t i = 0; i < lines.size(); ++i)
    canvas.draw_line(lines[i], scale * kLegendMargin, top + scale * static_cast<int>(i) * kLineHeight);
  return picture.height - static_cast<std::uint32_t>(strip);
}

}  // namespace gloam
