// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Metal balls over a mirror floor, against traced reflections with two bounces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

constexpr std::array<float, 7> kRoughness = {0.0f, 0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
constexpr double kBallRadius = 0.42;

/// Angle of a colour's hue in degrees.
double hue_of(const dvec3& c) {
  return std::atan2(std::sqrt(3.0) * (c.g - c.b), 2.0 * c.r - c.g - c.b) * 180.0 / std::numbers::pi;
}

/// Light of a ball's pixels.
struct BallLight {
  dvec3 drawn = dvec3(0.0), traced = dvec3(0.0);
  int pixels = 0;

  /// A highlight does not outweigh the ball.
  void add(const dvec3& found, const dvec3& expected) {
    drawn += glm::min(found, dvec3(4.0));
    traced += glm::min(expected, dvec3(4.0));
    ++pixels;
  }
  [[nodiscard]] dvec3 ratio() const { return drawn / traced; }
};

class MetalsInMirrors : public JudgedReflections {
 protected:
  void SetUp() override {
    JudgedReflections::SetUp();
    if (IsSkipped()) return;
    environment() = {.sky_zenith = {0.10f, 0.15f, 0.3f}, .sky_horizon = {0.2f, 0.2f, 0.25f}, .sky_ground = vec3(0.05f)};
    settings = look_at(dvec3(0.0, 0.7, 5.5), dvec3(0.0, 0.25, 0.0), 320, 180);
    settings.camera.fov_y = 0.75f;
    ground(mirror(0.0f), {0.0, 0.0, 0.0}, {6.0, 6.0});
    solid(matt({0.5f, 0.45f, 0.4f}), {0.0, 2.0, -5.0}, {6.0f, 2.0f, 0.1f});
    solid(matt({0.3f, 0.4f, 0.5f}), {-6.0, 2.0, 0.0}, {0.1f, 2.0f, 6.0f});
    solid(matt({0.5f, 0.35f, 0.3f}), {6.0, 2.0, 0.0}, {0.1f, 2.0f, 6.0f});
    solid(matt(vec3(0.4f)), {0.0, 2.0, 6.5}, {6.0f, 2.0f, 0.1f});
    for (int i = 0; i < 5; ++i) solid(glow(vec3(2.0f)), {-4.0 + 2.0 * i, 1.6, -4.8}, {0.5f, 0.8f, 0.05f});
    Light what;
    what.intensity = 8.0f;
    what.width_m = 1.2f;  // a highlight that a rough ball's rays find
    lamp(what, {1.0, 3.5, 3.0});
    for (std::size_t i = 0; i < kRoughness.size(); ++i) {
      Material gold;
      gold.base_color = {1.0f, 0.77f, 0.34f, 1.0f};
      gold.metallic = 1.0f;
      gold.roughness = kRoughness[i];
      scene.draw(scene.mesh(round_ball(static_cast<float>(kBallRadius), 64, 32, scene.material(gold))),
                 glm::translate(dmat4(1.0), center(i)));
    }
    probe({12.4f, 8.0f, 12.8f}, {0.0, 2.5, 0.75});  // the floor is not near its border, where it fades
    probe({}, {0.0, 2.5, 0.75}, true);
    bake(world);
  }
  [[nodiscard]] static dvec3 center(std::size_t ball) { return {-2.7 + 0.9 * static_cast<double>(ball), 0.5, 0.0}; }
  /// Distance to a ball along a ray.
  [[nodiscard]] static std::optional<double> meet(const dvec3& origin, const dvec3& direction, std::size_t ball) {
    const dvec3 to = center(ball) - origin;
    const double along = glm::dot(to, direction), off2 = glm::dot(to, to) - along * along;
    if (off2 > kBallRadius * kBallRadius || along <= 0.0) return std::nullopt;
    return along - std::sqrt(kBallRadius * kBallRadius - off2);
  }
  /// The ball on a pixel.
  [[nodiscard]] std::optional<std::size_t> direct_ball(std::uint32_t x, std::uint32_t y) const {
    const Ray view = ray(x, y);
    for (std::size_t ball = 0; ball < kRoughness.size(); ++ball)
      if (meet(view.origin, view.direction, ball)) return ball;
    return std::nullopt;
  }
  /// The ball that a floor pixel mirrors if the camera sees the mirrored point, too: screen space can show it.
  [[nodiscard]] std::optional<std::size_t> mirrored_ball(const GeometryPicture& seen, std::uint32_t x,
                                                         std::uint32_t y) const {
    if (seen.is_sky(std::size_t{y} * settings.width + x)) return std::nullopt;
    const dvec3 eye = seen.view.position, relative = seen.position(x, y), at = relative + eye;
    if (std::abs(at.y) > 1e-3) return std::nullopt;
    const dvec3 direction = glm::normalize(relative * dvec3(1.0, -1.0, 1.0));
    std::optional<std::size_t> nearest;
    double best = 1e9;
    for (std::size_t ball = 0; ball < kRoughness.size(); ++ball)
      if (const auto distance = meet(at, direction, ball); distance && *distance < best)
        best = *distance, nearest = ball;
    if (!nearest) return std::nullopt;
    const dvec3 point = at + best * direction, normal = (point - center(*nearest)) / kBallRadius;
    if (glm::dot(normal, glm::normalize(eye - point)) < 0.15 || glm::dot(normal, -direction) < 0.15)
      return std::nullopt;
    return nearest;
  }
};

// Screen space finds the ball and takes its surroundings from a probe, which shows them from another point and blurred
// in steps of mips: 20 % of a channel's mean and 8 degrees of hue. The balls beside the mirror, which have the same
// surroundings, are within 13 %. Without surroundings the ratio is 0.1 to 0.6.
TEST_F(MetalsInMirrors, have_the_colour_that_they_have_beside_the_mirror) {
  const LinearPicture found = drawn(), expected = traced(64);
  const GeometryPicture seen = geometry();
  std::array<BallLight, kRoughness.size()> mirrored{}, direct{};
  for (std::uint32_t y = 0; y < settings.height; ++y)
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      const bool ahead = !seen.is_sky(std::size_t{y} * settings.width + x);
      if (const auto ball = mirrored_ball(seen, x, y)) mirrored[*ball].add(pixel(found, x, y), pixel(expected, x, y));
      if (const auto ball = direct_ball(x, y); ball && ahead)
        direct[*ball].add(pixel(found, x, y), pixel(expected, x, y));
    }
  for (std::size_t i = 0; i < kRoughness.size(); ++i) {
    const dvec3 ratio = mirrored[i].ratio(), beside = direct[i].ratio();
    const double hue = hue_of(mirrored[i].drawn) - hue_of(mirrored[i].traced);
    std::printf(
        "roughness %.1f: %4d pixels, drawn over traced %.2f %.2f %.2f, hue %+.1f degrees (beside the mirror %.2f %.2f "
        "%.2f)\n",
        static_cast<double>(kRoughness[i]), mirrored[i].pixels, ratio.r, ratio.g, ratio.b, hue, beside.r, beside.g,
        beside.b);
    EXPECT_GT(mirrored[i].pixels, 100);
    const std::string what = "roughness " + std::to_string(kRoughness[i]);
    for (int c = 0; c < 3; ++c) expect_at_most(std::abs(ratio[c] - 1.0), 0.2, 0.5, what + ": ratio off by");
    expect_at_most(std::abs(hue), 8.0, 11.0, what + ": hue off by");
  }
}

}  // namespace
}  // namespace gloam::test
