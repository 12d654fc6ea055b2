// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

/// A ball of few facets with smooth normals, lit from the side.
class ShadowTerminator : public test::HardShadows {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HardShadows::SetUp());
    if (IsSkipped()) return;
    settings = test::look_at(dvec3(0.0, 0.4, 1.6), dvec3(0.0), 160, 160);
  }
  void put_ball() {
    thing(test::round_ball(kRadius, 12, 8, stone), glm::rotate(dmat4(1.0), 0.13, dvec3(0.0, 1.0, 0.0)));
  }

  /// Visibility of a light around the terminator, by the cosine between the smooth normal and the direction from the
  /// smooth surface to the emitter's centre.
  struct Terminator {
    double least_before = 1.0;  ///< least visibility where the cosine is above a margin
    double most_behind = 0.0;   ///< greatest visibility where it is below minus the margin
    /// How far the mean visibility of a hundredth of cosines is below that of any with smaller cosines.
    double fall = 0.0;
  };
  [[nodiscard]] Terminator terminator(Entity lamp, double margin) {
    const std::vector<float> seen = visibility(lamp);
    const GeometryPicture geometry = test::value_of(renderer->read_geometry(world, settings.id));
    const dmat4& node = world.get<WorldTransform>(lamp).matrix;
    const bool directional = world.get<Light>(lamp).kind == LightKind::directional;
    std::vector<double> sums(200), counts(200);
    Terminator found;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (geometry.is_sky(i) || seen[i] < 0.0f) continue;
      const auto x = static_cast<std::uint32_t>(i % settings.width), y = static_cast<std::uint32_t>(i / settings.width);
      const dvec3 point = geometry.position(x, y) + geometry.view.position + dvec3(geometry.smooth_surface(i).offset);
      const dvec3 to_light = directional ? dvec3(node[2]) : dvec3(node[3]) - point;
      const double cosine = glm::dot(dvec3(geometry.texel(i).normal), glm::normalize(to_light));
      const double visible = static_cast<double>(seen[i]);
      if (cosine > margin) found.least_before = std::min(found.least_before, visible);
      if (cosine < -margin) found.most_behind = std::max(found.most_behind, visible);
      const auto bin = static_cast<std::size_t>(std::clamp(100.0 * (cosine + 1.0), 0.0, 199.0));
      sums[bin] += visible;
      counts[bin] += 1.0;
    }
    double most = 0.0;
    for (std::size_t bin = 0; bin < sums.size(); ++bin) {
      if (counts[bin] < 5.0) continue;
      most = std::max(most, sums[bin] / counts[bin]);
      found.fall = std::max(found.fall, most - sums[bin] / counts[bin]);
    }
    return found;
  }

  /// Greatest visibility drawn where rays find the light hidden at this pixel and all around it.
  [[nodiscard]] float deepest_leak(Entity lamp, const TracedVisibility& traced) {
    constexpr std::uint32_t kAround = 5;
    const std::vector<float> seen = visibility(lamp);
    const std::span<const std::uint8_t> rays = traced.layer(traced.layer_of(lamp).value());
    float most = 0.0f;
    std::size_t hidden = 0;
    for (std::uint32_t y = kAround; y + kAround < traced.height; ++y)
      for (std::uint32_t x = kAround; x + kAround < traced.width; ++x) {
        bool all = true;
        for (std::uint32_t row = y - kAround; row <= y + kAround && all; ++row)
          for (std::uint32_t column = x - kAround; column <= x + kAround; ++column)
            all = all && rays[std::size_t{row} * traced.width + column] == 0;
        if (all) most = std::max(most, seen[std::size_t{y} * traced.width + x]);
        hidden += all ? 1 : 0;
      }
    EXPECT_GT(hidden, traced.pixels() / 20);
    return most;
  }

  static constexpr float kRadius = 0.5f;
};

TEST_F(ShadowTerminator, shadows_of_a_low_poly_ball_do_not_follow_its_facets) {
  put_ball();
  const struct {
    const char* name;
    Entity light;
    double emitter_sine;  ///< greatest sine of half the angle that the emitter covers
  } lights[] = {
      {"lamp", lamp(point(0.05f), dvec3(1.9, 0.4, 0.2)), 0.025 / 1.4},
      {"lamp without width", lamp(point(), dvec3(1.9, 0.4, 0.2)), 0.0},
      {"spot", lamp(spot(30.0, 0.05f), dvec3(-1.2, 1.2, 0.8), dvec3(1.2, -1.2, -0.8)), 0.025 / 1.4},
      {"sun", lamp(sun(0.01f), dvec3(0.0), dvec3(-1.0, -0.2, -0.1)), 0.005},
      {"wide sun", lamp(sun(0.2f), dvec3(0.0), dvec3(1.0, 0.3, -0.1)), 0.1},
  };
  for (const auto& [filter, on] : {std::pair("chs", false), std::pair("chs", true), std::pair("pcss", true),
                                   std::pair("pcf", true), std::pair("hard", true)}) {
    set("shadows.filter", filter);
    set("shadows.terminator", on ? "on" : "off");
    const TracedVisibility traced = trace();
    for (const auto& [name, light, sine] : lights) {
      const std::string what = std::string(filter) + ", " + name + (on ? ", on" : ", off");
      expect_right(what, error(light, traced));
      const Terminator seen = terminator(light, sine + 0.01);
      std::printf("%-34s least before %.3f, most behind %.3f, fall %.3f\n", "", seen.least_before, seen.most_behind,
                  seen.fall);
      if (on) {
        EXPECT_GE(seen.least_before, 0.99) << what;
        EXPECT_LE(seen.most_behind, 0.01) << what;
        EXPECT_LE(seen.fall, 0.01) << what;
      } else {
        EXPECT_LE(seen.least_before, 0.1) << what;
        EXPECT_GE(seen.most_behind, 0.9) << what;
      }
    }
  }
}

TEST_F(ShadowTerminator, shadows_that_other_things_cast_on_smooth_surfaces_stay_right) {
  set("shadows.terminator", "on");
  yard();
  put_ball();
  thing(test::round_ball(0.3f, 7, 5, stone), at(0.8, 0.45, 0.7));
  settings = test::look_at(dvec3(0.3, 2.2, 3.4), dvec3(0.0, 0.3, 0.0), 160, 90);
  const Entity round = lamp(point(0.1f), dvec3(0.9, 1.8, 0.9));
  const Entity day = lamp(sun(0.02f), dvec3(0.0), dvec3(0.5, -0.8, -0.4));
  const TracedVisibility traced = trace();
  expect_right("lamp over a yard", error(round, traced));
  expect_right("sun over a yard", error(day, traced));
}

TEST_F(ShadowTerminator, lies_in_the_shadow_of_another_ball_without_a_line_of_light) {
  set("shadows.terminator", "on");
  thing(test::round_ball(kRadius, 12, 8, stone), at(-0.6, 0.55, 0.0));
  thing(test::round_ball(kRadius, 12, 8, stone), glm::rotate(at(0.7, 0.55, 0.2), 0.35, dvec3(0.0, 1.0, 0.0)));
  floor();
  settings = test::look_at(dvec3(0.0, 0.9, 2.6), dvec3(-0.4, 0.5, 0.0), 320, 180);
  const Entity low = lamp(point(0.06f), dvec3(2.6, 1.3, 0.9));
  const Entity day = lamp(sun(0.02f), dvec3(0.0), dvec3(-2.0, -0.7, -0.7));
  const TracedVisibility traced = trace();
  for (const Entity light : {low, day}) expect_right("ball in the shadow of another", error(light, traced));
  for (const char* filter : {"chs", "pcss", "pcf", "hard"}) {
    set("shadows.filter", filter);
    for (const Entity light : {low, day}) EXPECT_LE(deepest_leak(light, traced), 0.02f) << filter;
  }
}

TEST_F(ShadowTerminator, both_modes_draw_the_same_picture) {
  set("shadows.terminator", "on");
  set("shadows.visibility_bits", "8");
  yard();
  put_ball();
  lamp(point(0.1f), dvec3(1.9, 0.8, 0.2));
  lamp(spot(40.0), dvec3(-1.2, 1.2, 0.8), dvec3(1.2, -1.2, -0.8));
  lamp(sun(0.02f), dvec3(0.0), dvec3(-1.0, -0.3, -0.1));
  settings = test::look_at(dvec3(0.3, 1.2, 2.4), dvec3(0.0, 0.3, 0.0), 160, 90);
  set("shadows.mode", "monolithic");
  const LinearPicture whole = drawn();
  set("shadows.mode", "deferred");
  for (const char* classify : {"off", "on"}) {
    set("shadows.classify", classify);
    draw();
    EXPECT_EQ(drawn().rgba, whole.rgba) << "shadows.classify=" << classify;
    EXPECT_GT(counter("shadows.tile_lights_filtered"), 0.0);
  }
}

TEST_F(ShadowTerminator, flat_shaded_meshes_look_the_same_and_the_knob_costs_nothing_when_off) {
  floor();
  box(dvec3(0.0, 0.3, 0.0), dvec3(0.3), 0.4);
  lamp(point(0.1f), dvec3(0.9, 0.8, 0.2));
  lamp(sun(0.02f), dvec3(0.0), dvec3(-1.0, -0.2, -0.1));
  const auto made = [&] { return renderer->read_image(world, settings.id, "smooth_surfaces").ok(); };
  // In the second round there is a ball beside the picture: flat-shaded meshes are drawn by shaders that read smooth
  // surfaces.
  for (const bool with_ball : {false, true}) {
    if (with_ball) thing(test::round_ball(0.2f, 12, 8, stone), at(0.0, 30.0, 0.0));
    set("shadows.terminator", "off");
    const LinearPicture before = drawn();
    EXPECT_FALSE(made());
    set("shadows.terminator", "on");
    EXPECT_EQ(drawn().rgba, before.rgba);
    EXPECT_EQ(made(), with_ball);
  }
  set("shadows.mode", "off");
  draw();
  EXPECT_FALSE(made()) << "nothing is judged";
}

TEST_F(ShadowTerminator, subsurface_materials_are_judged_where_they_are_drawn) {
  Material skin = exact_material(170, 180, 160, 255, 0);
  skin.subsurface = true;
  thing(test::round_ball(kRadius, 12, 8, scene.material(skin)));
  const Entity low = lamp(point(0.05f), dvec3(1.9, 0.4, 0.2));
  const std::vector<float> before = visibility(low);
  set("shadows.terminator", "on");
  EXPECT_EQ(visibility(low), before);
}

}  // namespace
}  // namespace gloam
