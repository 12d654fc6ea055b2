// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/math/packing.h"
#include "modules/lighting/antialiasing/smooth_edges_passes.h"
#include "tests/support/gpu_device.h"
#include "tests/support/pass_frame.h"

namespace gloam::test {

/// A picture in displayed linear light; `w` is the brightness to the eye. Values are those of half floats.
struct ShownPicture {
  int width = 1;
  int height = 1;
  std::vector<vec4> pixels;

  ShownPicture(int w, int h, const std::function<double(int x, int y)>& grey) : width(w), height(h) {
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const double light = grey(x, y);
        const float shown = rounded(light), brightness = rounded(std::sqrt(light));
        pixels.emplace_back(shown, shown, shown, brightness);
      }
  }
  [[nodiscard]] vec4& at(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
  [[nodiscard]] const vec4& at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
  [[nodiscard]] static float rounded(double value) { return half_to_float(float_to_half(static_cast<float>(value))); }
};

/// Shares of a pixel that its upper, lower, left and right neighbours cover.
using Shares = std::array<double, 4>;

/// The shares that shaders/lighting/antialiasing finds, in double precision and pixel by pixel.
class SharesTwin {
 public:
  explicit SharesTwin(const ShownPicture& picture) : picture_(picture) {}

  [[nodiscard]] Shares shares(int x, int y) const {
    const Shares all = {cut(true, y, x).y, cut(true, y + 1, x).x, cut(false, x, y).y, cut(false, x + 1, y).x};
    const bool vertical = std::max(all[0], all[1]) > std::max(all[2], all[3]) + 1e-4;
    return vertical ? Shares{all[0], all[1], 0.0, 0.0} : Shares{0.0, 0.0, all[2], all[3]};
  }

 private:
  [[nodiscard]] double brightness(bool rows, int line, int position) const {
    const int inside = std::clamp(line, 0, (rows ? picture_.height : picture_.width) - 1);
    return static_cast<double>((rows ? picture_.at(position, inside) : picture_.at(inside, position)).w);
  }
  /// 1: the pixel before the edge is the brighter one; −1: the pixel after it; 0: no edge.
  [[nodiscard]] int edge(bool rows, int line, int position) const {
    const int lines = rows ? picture_.height : picture_.width, length = rows ? picture_.width : picture_.height;
    if (line < 1 || line >= lines || position < 0 || position >= length) return 0;
    const double before = brightness(rows, line - 1, position), after = brightness(rows, line, position);
    const double rise = before - after;
    if (!(std::abs(rise) >= static_cast<double>(0.05f))) return 0;
    for (const double beside :
         {brightness(rows, line - 2, position) - before, after - brightness(rows, line + 1, position)})
      if (std::abs(beside) > 2.0 * std::abs(rise)) return 0;
    return rise > 0.0 ? 1 : -1;
  }
  /// The contour's height at an end of an edge, in half pixels toward the pixels before it.
  [[nodiscard]] int turn(bool rows, int line, int end, int side, bool first_end) const {
    const int beyond = first_end ? end - 1 : end, before = first_end ? -side : side;
    const bool toward = edge(!rows, end, line - 1) == before && edge(rows, line - 1, beyond) == side;
    const bool away = edge(!rows, end, line) == -before && edge(rows, line + 1, beyond) == side;
    return toward == away ? 0 : (toward ? 1 : -1);
  }
  /// Integral over a pixel of the positive part of the line from 0.5 at position 0 to 0 at length / 2.
  [[nodiscard]] static double below_line(int position, int length) {
    const double left = std::max(0.0, 0.5 * length - position), right = std::max(0.0, left - 1.0);
    return 0.5 * (left * left - right * right) / length;
  }
  [[nodiscard]] glm::dvec2 cut(bool rows, int line, int position) const {
    const int side = edge(rows, line, position);
    if (side == 0) return glm::dvec2(0.0);
    int back = 0, forth = 0;
    while (back < 40 && edge(rows, line, position - back - 1) == side) ++back;
    while (forth < 40 && edge(rows, line, position + forth + 1) == side) ++forth;
    const int begins = back > 32 ? 0 : turn(rows, line, position - back, side, true);
    const int ends = forth > 32 ? 0 : turn(rows, line, position + forth + 1, side, false);
    back = std::min(back, 32);
    forth = std::min(forth, 32);
    const int length = back + forth + 1;
    glm::dvec2 areas(0.0);
    if (begins != 0) areas[begins > 0 ? 0 : 1] += below_line(back, length);
    if (ends != 0) areas[ends > 0 ? 0 : 1] += below_line(forth, length);
    return areas;
  }

  const ShownPicture& picture_;
};

/// What the GPU finds in a picture.
struct FoundWeights {
  std::vector<std::uint32_t> weights;  ///< four 8-bit shares for each pixel
  std::vector<uvec2> rectangles;       ///< drawn ones, as in weights.comp.glsl
};
[[nodiscard]] inline FoundWeights find_weights(gpu::Device& device, const ShownPicture& picture) {
  std::vector<std::array<std::uint16_t, 4>> halves;
  for (const vec4& pixel : picture.pixels)
    halves.push_back({float_to_half(pixel.x), float_to_half(pixel.y), float_to_half(pixel.z), float_to_half(pixel.w)});
  RenderView view;
  view.width = static_cast<std::uint32_t>(picture.width);
  view.height = static_cast<std::uint32_t>(picture.height);
  const std::uint32_t words = (view.width + 31) / 32;
  ReadPassFrames frames(device, view);
  const gpu::ImageHandle image = frames.make_image(kShownFormat, view.width, view.height, halves);
  frames.draw([&](FrameBuilder& frame) {
    frame.set_module("lighting");
    const AntialiasingWeights drawn = add_antialiasing_weights(frame, frames.input("shown", image));
    frames.keep(frame, "weights", drawn.weights, sizeof(std::uint32_t) * picture.pixels.size());
    frames.keep(frame, "masks", drawn.masks, sizeof(std::uint32_t) * words * view.height);
    frames.keep(frame, "command", drawn.command, sizeof(uvec4));
    frames.keep(frame, "rectangles", drawn.rectangles, frame.graph().desc(drawn.rectangles).size);
  });
  FoundWeights found{frames.read<std::uint32_t>("weights"), frames.read<uvec2>("rectangles")};
  const uvec4 command = frames.read<uvec4>("command").front();
  EXPECT_EQ(command.x % 6, 0u) << "two triangles a rectangle";
  EXPECT_LE(command.x / 6, found.rectangles.size());
  found.rectangles.resize(std::min<std::size_t>(command.x / 6, found.rectangles.size()));
  const std::vector<std::uint32_t> masks = frames.read<std::uint32_t>("masks");
  for (std::uint32_t i = 0; i < picture.pixels.size(); ++i) {
    const std::uint32_t x = i % view.width, y = i / view.width;
    if ((masks[y * words + x / 32] >> (x % 32) & 1u) == 0) found.weights[i] = 0;
  }
  return found;
}
[[nodiscard]] inline std::vector<std::uint32_t> antialiasing_weights(gpu::Device& device, const ShownPicture& picture) {
  return find_weights(device, picture).weights;
}

[[nodiscard]] inline Shares unpacked(std::uint32_t weights) {
  Shares shares{};
  for (std::size_t n = 0; n < 4; ++n) shares[n] = (weights >> (8 * n) & 255u) / 255.0;
  return shares;
}

/// The picture blended with weights as blend.frag.glsl does: one grey value for each pixel.
[[nodiscard]] inline std::vector<double> blended(const ShownPicture& picture,
                                                 const std::vector<std::uint32_t>& weights) {
  std::vector<double> result;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Shares s = unpacked(weights[static_cast<std::size_t>(y * picture.width + x)]);
      const double own = static_cast<double>(picture.at(x, y).x);
      double value = own;
      const auto add = [&](double share, double sum, int nx, int ny) {
        if (share > 0.0) value += share * share / sum * (static_cast<double>(picture.at(nx, ny).x) - own);
      };
      add(s[0], s[0] + s[1], x, y - 1);
      add(s[1], s[0] + s[1], x, y + 1);
      add(s[2], s[2] + s[3], x - 1, y);
      add(s[3], s[2] + s[3], x + 1, y);
      result.push_back(value);
    }
  return result;
}

/// Tests on a validated device.
class AntialiasingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device());
    messages_ = device()->validation_messages();
  }
  void TearDown() override {
    if (device() != nullptr) {
      EXPECT_EQ(device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device();
    return made.get();
  }

 private:
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test
