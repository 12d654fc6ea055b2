// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Reflection images of half size against those of full size, where full size is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

constexpr double kRight = 0.02;  // of white: full size shows what rays show
constexpr double kMost = 0.1;    // of white
constexpr double kEdge = 0.05;   // of white: contrast of an edge in the reflection

class HalfResolution : public JudgedReflections {
 protected:
  void SetUp() override {
    JudgedReflections::SetUp();
    if (IsSkipped()) return;
    environment() = {.sky_zenith = {0.05f, 0.08f, 0.2f}, .sky_horizon = {0.1f, 0.1f, 0.12f}, .sky_ground = vec3(0.05f)};
    settings = look_at(dvec3(0.3, 1.4, 4.0), dvec3(0.0, 0.2, 0.0), 320, 180);
    settings.camera.fov_y = 0.8f;
  }
  void posts() {
    for (int i = 0; i < 9; ++i) {
      const vec3 light = i % 3 == 0   ? vec3(0.9f, 0.2f, 0.1f)
                         : i % 3 == 1 ? vec3(0.1f, 0.8f, 0.3f)
                                      : vec3(0.2f, 0.4f, 0.9f);
      solid(glow(light), {-1.6 + 0.4 * i, 0.4, 0.3 * (i % 2)}, {0.03f, 0.4f, 0.03f});
    }
  }
  /// A turned block of one colour: along its contact with the floor, the reflection is plain.
  void block() {
    dmat4 place = glm::rotate(at(0.2, 0.3, 0.9), 0.35, dvec3(0.0, 1.0, 0.0));
    scene.draw(scene.mesh(box(vec3(0.5f, 0.3f, 0.2f), scene.material(glow({0.8f, 0.6f, 0.2f})))), place);
  }
  [[nodiscard]] bool is_floor(const GeometryPicture& seen, std::uint32_t x, std::uint32_t y) const {
    if (seen.is_sky(std::size_t{y} * settings.width + x)) return false;
    return std::abs(seen.position(x, y).y + seen.view.position.y) < 1e-3;
  }
  /// Greatest difference of colours within a pixel about a floor pixel, on floor of the same roughness.
  [[nodiscard]] double contrast(const LinearPicture& picture, const GeometryPicture& seen, std::uint32_t x,
                                std::uint32_t y) const {
    const auto roughness = [&](std::uint32_t u, std::uint32_t v) {
      return seen.texel(std::size_t{v} * settings.width + u).roughness;
    };
    dvec3 least(1.0), most(0.0);
    for (std::uint32_t v = std::max(y, 1u) - 1; v < std::min(y + 2, picture.height); ++v)
      for (std::uint32_t u = std::max(x, 1u) - 1; u < std::min(x + 2, picture.width); ++u) {
        if (!is_floor(seen, u, v) || roughness(u, v) != roughness(x, y)) continue;
        least = glm::min(least, shown_light(pixel(picture, u, v)));
        most = glm::max(most, shown_light(pixel(picture, u, v)));
      }
    return greatest(most - least);
  }
  /// Judges the floor's pixels. A ray of a half-size image stands for 2x2 pixels, so that edges of what is reflected
  /// may move by a pixel. Where full size shows no such edge, half size shows the same, also beside another surface.
  void judge(const char* what, std::uint32_t rays, std::size_t least_right) {
    set("ssr.resolution", "full");
    const LinearPicture full = drawn(), expected = traced(rays);
    set("ssr.resolution", "half");
    const LinearPicture half = drawn();
    const GeometryPicture seen = geometry();
    std::size_t right = 0, floor = 0, moved = 0, wrong = 0;
    double worst = 0.0, sum = 0.0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        if (!is_floor(seen, x, y)) continue;
        ++floor;
        const dvec3 at_full = shown_light(pixel(full, x, y)), at_half = shown_light(pixel(half, x, y));
        if (greatest(glm::abs(at_full - shown_light(pixel(expected, x, y)))) > kRight) continue;
        const double off = greatest(glm::abs(at_full - at_half));
        ++right;
        sum += off;
        if (contrast(full, seen, x, y) > kEdge) {
          moved += off > kMost ? 1 : 0;
        } else {
          wrong += off > kMost ? 1 : 0;
          worst = std::max(worst, off);
        }
      }
    std::printf(
        "%s: full size is right in %zu of %zu pixels; half size differs by %.4f in the mean, by more than %.1f in "
        "%zu at reflected edges and in %zu elsewhere (%.2f at most)\n",
        what, right, floor, sum / static_cast<double>(std::max<std::size_t>(right, 1)), kMost, moved, wrong, worst);
    EXPECT_GT(right, least_right);
    expect_at_most(static_cast<double>(wrong), 0.0, 3.0, "pixels off");
  }
};

TEST_F(HalfResolution, keeps_contacts) {
  ground(mirror(0.0f), {0.0, 0.0, 0.0}, {6.0, 6.0});
  posts();
  block();
  judge("contacts", 1, 15000);
}

TEST_F(HalfResolution, keeps_borders_between_roughnesses) {
  // Strips along the view, smooth and rough in turn.
  for (int i = 0; i < 10; ++i) ground(mirror(i % 2 == 0 ? 0.0f : 0.3f), {-2.7 + 0.6 * i, 0.0, 0.0}, {0.3, 6.0});
  posts();
  block();
  judge("borders of roughness", 64, 8000);
}

TEST_F(HalfResolution, keeps_borders_between_tiers) {
  // The upper part of the wall is above the picture: a proxy shows it.
  settings = look_at(dvec3(0.3, 1.4, 4.0), dvec3(0.0, -0.9, 0.0), 320, 180);
  settings.camera.fov_y = 0.8f;
  ground(mirror(0.0f), {0.0, 0.0, 0.0}, {6.0, 6.0});
  posts();
  for (int i = 0; i < 8; ++i)
    solid(glow(vec3(i % 2 == 0 ? 0.7f : 0.25f, 0.4f, 0.3f)), {-3.5 + i, 1.5, -1.5}, {0.5f, 1.5f, 0.05f});
  proxy(vec2(8.0f, 3.0f), at(0.0, 1.5, -1.45));
  probe({}, {0.0, 40.0, 0.0}, true);  // above the wall: of the sky
  bake(world);
  judge("borders of tiers", 1, 10000);
}

}  // namespace
}  // namespace gloam::test
