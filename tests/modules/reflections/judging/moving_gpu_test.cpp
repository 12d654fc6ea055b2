// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Reflections that are accumulated over frames (reflections.temporal=on), of things that move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

constexpr double kGone = 0.05;  // of the contrast that a thing had
constexpr int kFrames = 4;

class MovingReflections : public JudgedReflections {
 protected:
  void SetUp() override {
    JudgedReflections::SetUp();
    if (IsSkipped()) return;
    environment() = {.sky_zenith = {0.05f, 0.08f, 0.2f}, .sky_horizon = {0.1f, 0.1f, 0.12f}, .sky_ground = vec3(0.05f)};
    settings = look_at(dvec3(0.3, 1.4, 4.0), dvec3(0.0, 0.2, 0.0), 160, 90);
    settings.camera.fov_y = 0.8f;
    solid(glow({0.2f, 0.3f, 0.5f}), {0.0, 1.0, -3.0}, {4.0f, 1.0f, 0.05f});
    set("reflections.temporal", "on");
  }
  void place(const dvec3& at) { world.get<WorldTransform>(thing).matrix = glm::translate(dmat4(1.0), at); }
  void settle() {
    for (int i = 0; i < 24; ++i) draw();
  }
  /// Mean contrast with a picture, over pixels that showed the thing in reflection: 1 as much as the thing had.
  [[nodiscard]] double left(const LinearPicture& now, const LinearPicture& with, const LinearPicture& without,
                            const std::vector<std::size_t>& pixels) const {
    double sum = 0.0, all = 0.0;
    for (const std::size_t i : pixels)
      for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
        sum += std::abs(static_cast<double>(now.rgba[c]) - static_cast<double>(without.rgba[c]));
        all += std::abs(static_cast<double>(with.rgba[c]) - static_cast<double>(without.rgba[c]));
      }
    return sum / all;
  }
  /// Floor pixels whose colour differs between two pictures.
  [[nodiscard]] std::vector<std::size_t> changed(const LinearPicture& a, const LinearPicture& b,
                                                 const GeometryPicture& seen) const {
    std::vector<std::size_t> pixels;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        const std::size_t at = std::size_t{y} * settings.width + x;
        if (seen.is_sky(at) || std::abs(seen.position(x, y).y + seen.view.position.y) > 1e-3) continue;
        if (greatest(glm::abs(pixel(a, x, y) - pixel(b, x, y))) > 0.1) pixels.push_back(at);
      }
    return pixels;
  }
  /// Draws the thing at one place until it settles, then at another, and prints how much of it is left, by frames.
  void judge(float roughness, const dvec3& from, const dvec3& to) {
    ground(mirror(roughness), {0.0, 0.0, 0.0}, {4.0, 4.0});
    thing = solid(glow({3.0f, 1.0f, 0.3f}), from, vec3(0.25f));
    place(to);
    settle();
    const LinearPicture without = linear();
    const GeometryPicture seen = geometry();
    place(from);
    settle();
    const LinearPicture with = linear();
    const GeometryPicture seen_before = geometry();
    std::vector<std::size_t> pixels = changed(with, without, seen);
    std::erase_if(pixels, [&](std::size_t i) { return seen_before.depth[i] != seen.depth[i]; });
    ASSERT_GT(pixels.size(), 60u);
    place(to);
    std::printf("roughness %.1f, left after frames 1, 2, ...:", static_cast<double>(roughness));
    double after = 1.0;
    for (int frame = 0; frame < kFrames; ++frame) {
      draw();
      after = left(linear(), with, without, pixels);
      std::printf(" %.3f", after);
    }
    std::printf("\n");
    EXPECT_LT(after, kGone);
  }

  Entity thing;
};

TEST_F(MovingReflections, a_thing_that_leaves_is_gone_within_four_frames) {
  judge(0.0f, {0.0, 0.4, 0.0}, {0.0, 0.4, 300.0});
}
TEST_F(MovingReflections, a_thing_that_leaves_a_rough_mirror_is_gone_within_four_frames) {
  judge(0.2f, {0.0, 0.4, 0.0}, {0.0, 0.4, 300.0});
}
TEST_F(MovingReflections, a_thing_that_jumps_aside_leaves_no_trace) { judge(0.0f, {-0.6, 0.4, 0.0}, {0.6, 0.4, 0.0}); }

}  // namespace
}  // namespace gloam::test
