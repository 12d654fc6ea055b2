// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "sandbox/selftest/condition_curve.h"

namespace gloam {
namespace {

constexpr std::uint32_t kTracedSamples = 64;  // per pixel

/// The scene of the lamp, with another lamp.
TestScene lamp_of(double width_m, double range_m) {
  TestScene scene = bare_floor();
  const std::size_t red = scene.material({0.6, 0.3, 0.2}, 0.5);
  scene.box({0.3, 0.3, 0.2}, red, {-0.5, 0.3, 0.1}, turned_about(1, 0.4));
  scene.box({0.03, 0.5, 0.03}, red, {0.5, 0.5, -0.3});
  scene.light("point", {0.2, 2.1, 0.6}, 60.0, {{"range", range_m}}, {{"gloam.light.width", width_m}});
  return scene;
}

ConditionCurve light_width() {
  return {.check = curve_check("light_width", "shadows of a lamp against traced rays, by its width", "of the light",
                               0.006, "Use lamps that are smaller than what they light, or several smaller ones",
                               "width of the lamp, m", {1e-3, 0.8}),
          .axis_unit = "m",
          .quick = false,
          .values = {1e-4, 1e-3, 0.013, 0.1, 0.27, 0.8, 1.7, 3.0},
          .usual = {},
          .error_at = [](SelfTestContext& context, const TestPicture&, double value) {
            return context.reference_error(lamp_of(value, 9.0), {}, "shadows.filter", kTracedSamples);
          }};
}

ConditionCurve light_range() {
  return {.check = curve_check("light_range", "shadows of a lamp against traced rays, by its range", "of the light",
                               0.0015, "Give the light a range within which it lights something",
                               "range of the lamp, m", {3.0, 1e6}),
          .axis_unit = "m",
          .quick = false,
          .values = {2.3, 3.0, 9.0, 70.0, 1e3, 3.3e4, 1e6, 1e9},
          .usual = {},
          .error_at = [](SelfTestContext& context, const TestPicture&, double value) {
            return context.reference_error(lamp_of(0.1, value), {}, "shadows.filter", kTracedSamples);
          }};
}

/// No caster but the receiver, seen along its normal: whatever shadows take away is wrong.
ConditionCurve receiver_slope() {
  return {
      .check =
          curve_check("receiver_slope", "a sheet that nothing shadows, with and without shadows", kLevels, 0.1,
                      "Raise shadows.bias_mm", "angle between the sheet's normal and the light, degrees", {0.0, 89.0}),
      .axis_unit = "degrees",
      .quick = true,
      .values = {0.0, 13.0, 37.0, 60.0, 76.0, 85.0, 89.0, 89.5, 89.9},
      .usual = {},
      .error_at = [](SelfTestContext& context, const TestPicture&, double value) -> Result<double> {
        TestScene scene;
        const double angle = value * kOneDegree;
        scene.quad(0.8, scene.material(dvec3(0.5)), dvec3(0.0), turned_about(0, angle));
        scene.camera(2.4 * dvec3(0.0, std::cos(angle), std::sin(angle)), turned_about(0, angle - 90.0 * kOneDegree));
        scene.light("spot", {0.0, 2.0, 0.0}, 60.0 / std::cos(angle),
                    {{"range", 9.0}, {"spot", {{"outerConeAngle", 0.8}, {"innerConeAngle", 0.72}}}},
                    {{"gloam.light.width", 0.05}});
        const auto without = context.draw(scene, {}, {.knobs = {{"shadows.mode", "off"}}});
        if (!without) return without.error();
        return difference(context.draw(scene, {}, {.knobs = {{"shadows.classify", "off"}}}), *without);
      }};
}

ConditionCurve depth_range() {
  return {
      .check = curve_check("depth_range", "a camera with its far plane at 30 m and another near plane", kLevels, 0.1,
                           "Move the camera's planes closer to what it sees", "far plane over near plane", {1e2, 1e7}),
      .axis_unit = "times",
      .quick = false,
      .values = {1e2, 730.0, 1.7e4, 1e5, 3.3e6, 1e7, 1e10, 1e13},
      .usual = [](SelfTestContext& context) { return context.draw(effect_scene("lamp")); },
      .error_at =
          [](SelfTestContext& context, const TestPicture& usual, double value) {
            TestScene scene = effect_scene("lamp").make();
            scene.set_lens(0.8, 30.0 / value, 30.0);
            return difference(context.draw(scene, {}, {}), usual);
          }};
}

}  // namespace

void add_range_curves(std::vector<SelfTestCheck>& checks) {
  add_curve(light_width(), checks);
  add_curve(light_range(), checks);
  add_curve(receiver_slope(), checks);
  add_curve(depth_range(), checks);
}

}  // namespace gloam
