// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/formatted.h"
#include "sandbox/selftest/condition_curve.h"

namespace gloam {
namespace {

Result<double> relative_light(const Result<TestPicture>& drawn, const TestPicture& usual) {
  if (!drawn) return drawn.error();
  return std::abs(drawn->mean_light() / usual.mean_light() - 1.0);
}

std::function<Result<TestPicture>(SelfTestContext&)> usual_of(const char* scene) {
  return [scene](SelfTestContext& context) { return context.draw(effect_scene(scene)); };
}

ConditionCurve exposure() {
  return {.check = curve_check("exposure", "light and exposure changed by the same factor", kLevels, 0.5,
                               "Keep the exposure within the range where it holds, or set views.range=fit",
                               "exposure, EV", {-10.0, 20.0}),
          .axis_unit = "EV",
          .quick = true,
          .values = {-20.0, -10.0, -9.3, -5.0, -0.47, 0.0, 6.61, 10.0, 14.8, 19.9, 20.0, 30.0},
          .usual = usual_of("lamp"),
          .error_at = [](SelfTestContext& context, const TestPicture& usual, double value) {
            TestScene scene = effect_scene("lamp").make();
            scene.keys()["gloam.exposure"] = value;
            scene.brighten(std::exp2(value - 3.0));
            return difference(context.draw(scene, {}, {}), usual);
          }};
}

TestScene lamps_at_one_place(double count, bool shadows) {
  TestScene scene = effect_scene("lamp").make();
  scene.brighten(1.0 / count);
  for (int i = 1; i < static_cast<int>(count); ++i) {
    scene.light("point", {0.2, 2.1, 0.9}, 60.0 / count, {{"range", 9.0}}, {{"gloam.light.width", 0.4}});
    if (!shadows) scene.last_keys()["gloam.light.shadow"] = false;
  }
  return scene;
}

ConditionCurve lights_at_one_place() {
  return {.check = curve_check("lights_at_one_place", "one lamp divided into many at its place", kLevels, 1.0,
                               "Give lamps that share a place gloam.light.shadow false, or a larger shadows.atlas",
                               "lamps", {1.0, 1024.0}),
          .axis_unit = "lamps",
          .quick = false,
          .values = {2.0, 8.0, 64.0, 256.0, 1024.0},
          .usual = usual_of("lamp"),
          .error_at = [](SelfTestContext& context, const TestPicture& usual, double value) {
            return difference(context.draw(lamps_at_one_place(value, true), {}, {}), usual);
          }};
}

ConditionCurve near_plane() {
  return {.check = curve_check("near_plane", "a camera with another near plane, before everything that it sees",
                               kLevels, 0.5, "Move the camera's near plane closer to what it sees",
                               "distance of the near plane, m", {1e-4, 0.5}),
          .axis_unit = "m",
          .quick = false,
          .values = {1e-7, 1e-6, 1e-5, 1e-4, 3.1e-4, 1e-3, 7.7e-3, 0.01, 0.063, 0.1, 0.37, 0.5},
          .usual = usual_of("lamp"),
          .error_at = [](SelfTestContext& context, const TestPicture& usual, double value) {
            TestScene scene = effect_scene("lamp").make();
            scene.set_lens(0.8, value);
            return difference(context.draw(scene, {}, {}), usual);
          }};
}

ConditionCurve field_of_view() {
  return {
      .check = curve_check("field_of_view", "values that are not finite, by angle of the camera", "values", 0.0,
                           "Keep the camera's angle within the range where it holds", "angle, degrees", {0.01, 179.9}),
      .axis_unit = "degrees",
      .quick = false,
      .values = {0.01, 0.1, 1.0, 10.0, 90.0, 150.0, 179.0, 179.9},
      .usual = {},
      .error_at = [](SelfTestContext& context, const TestPicture&, double value) -> Result<double> {
        TestScene scene = effect_scene("puddle").make();
        scene.set_lens(value * kOneDegree, 0.05);
        const std::size_t before = context.non_finite();
        const auto drawn = context.draw(scene, {}, {});
        if (!drawn) return drawn.error();
        return static_cast<double>(context.non_finite() - before);
      }};
}

ConditionCurve picture_size() {
  return {.check = curve_check("picture_size", "mean light of the picture, by its size", "of the light", 0.03,
                               "Draw larger pictures", "width, pixels", {24.0, 1536.0}),
          .axis_unit = "pixels wide",
          .quick = false,
          .values = {1.0, 3.0, 6.0, 12.0, 24.0, 48.0, 96.0, 192.0, 768.0, 1536.0},
          .usual =
              [](SelfTestContext& context) {
                return context.draw(effect_scene("puddle").make(), {}, {.width = 384, .height = 256});
              },
          .error_at =
              [](SelfTestContext& context, const TestPicture& usual, double value) {
                const auto width = static_cast<std::uint32_t>(value);
                return relative_light(context.draw(effect_scene("puddle").make(), {},
                                                   {.width = width, .height = std::max(1u, width * 2 / 3)}),
                                      usual);
              }};
}

/// No caster: whatever shadows take away is wrong.
ConditionCurve grazing_light() {
  return {.check = curve_check("grazing_light", "a floor that nothing shadows, with and without shadows", kLevels, 0.5,
                               "Raise shadows.bias_mm", "height of the lamp over the floor, degrees", {1.0, 90.0}),
          .axis_unit = "degrees",
          .quick = true,
          .values = {0.1, 0.5, 1.0, 2.0, 5.0, 15.0, 45.0, 90.0},
          .usual = {},
          .error_at = [](SelfTestContext& context, const TestPicture&, double value) -> Result<double> {
            TestScene scene = bare_floor();
            const double angle = value * kOneDegree;
            scene.light("point", {2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0}, 60.0 / std::sin(angle),
                        {{"range", 9.0}}, {{"gloam.light.width", 0.05}});
            const auto without = context.draw(scene, {}, {.knobs = {{"shadows.mode", "off"}}});
            if (!without) return without.error();
            return difference(context.draw(scene, {}, {.knobs = {{"shadows.classify", "off"}}}), *without);
          }};
}

constexpr double kDays = 86400.0;

/// Mean light of what moves, which looks alike on average however it is drawn. change: of the view, by the value.
ConditionCurve moving(StabilityCheck check, const char* scene_name, bool quick, std::vector<double> values,
                      void (*change)(TestView& view, double value)) {
  return {.check = std::move(check),
          .axis_unit = "s",
          .quick = quick,
          .values = std::move(values),
          .usual = usual_of(scene_name),
          .error_at = [=](SelfTestContext& context, const TestPicture& usual, double value) {
            const EffectScene& scene = effect_scene(scene_name);
            TestView view = view_of(scene);
            change(view, value);
            return relative_light(context.draw(scene.make(), {}, view), usual);
          }};
}

ConditionCurve running_time(const char* name, const char* scene, const char* sentence) {
  return moving(curve_check(name, sentence, "of the light", 0.1, "Let the scene's clock begin anew",
                            "time since the start, s", {1.0, 30.0 * kDays}),
                scene, false, {10.0, 1e3, 1e5, 30.0 * kDays, 1e9},
                [](TestView& view, double value) { view.time_s = value; });
}

/// Blades stand where they stood, however long nothing was drawn.
ConditionCurve pause(const char* name, const char* scene, const char* sentence) {
  return moving(curve_check(name, sentence, "of the light", 0.1, "Reset the grass after a long pause",
                            "pause after the first frame, s", {1e-3, 30.0 * kDays}),
                scene, true, {1e-3, 0.1, 1.0, 10.0, 1e3, 30.0 * kDays, 1e9},
                [](TestView& view, double value) { view.pause_s = value; });
}

ConditionCurve frame_time(const char* name, const char* scene, const char* sentence) {
  return moving(curve_check(name, sentence, "of the light", 0.1, "Give the renderer shorter time steps", "time step, s",
                            {1e-3, 1.0}),
                scene, false, {1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0}, [](TestView& view, double value) {
                  view.dt_s = value;
                  view.frames = 30;
                });
}

}  // namespace

void add_condition_curves(std::vector<SelfTestCheck>& checks) {
  add_curve(exposure(), checks);
  add_curve(lights_at_one_place(), checks);
  add_curve(near_plane(), checks);
  add_curve(field_of_view(), checks);
  add_curve(picture_size(), checks);
  add_curve(grazing_light(), checks);
  add_curve(running_time("running_time.smoke", "smoke", "mean light of smoke, by the time since the start"), checks);
  add_curve(pause("pause.lawn", "lawn", "mean light of grass in the wind, by a pause between two frames"), checks);
  add_curve(frame_time("frame_time.smoke", "smoke", "mean light of smoke, by the time step"), checks);
  add_curve(frame_time("frame_time.lawn", "lawn", "mean light of grass in the wind, by the time step"), checks);
}

}  // namespace gloam
