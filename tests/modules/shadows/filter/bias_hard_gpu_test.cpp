// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/modules/shadows/support/hard_shadows.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

class ShadowBias : public test::HardShadows {
 protected:
  struct Shares {
    double wrong, acne, leak;
  };
  [[nodiscard]] Shares shares(const std::vector<Entity>& lamps, const TracedVisibility& traced,
                              const std::string& what) {
    ShadowError sum;
    for (const Entity lamp : lamps) sum += error(lamp, traced);
    print(what, sum);
    return {sum.wrong_share(), sum.acne_share(), sum.leak_share()};
  }
};

TEST_F(ShadowBias, oriented_has_neither_acne_nor_leaks_and_beats_constant_units) {
  yard();
  settings.width = 160;
  settings.height = 90;
  const std::vector<Entity> lamps = {lamp(point(), dvec3(-1.3, 1.9, 1.1)),
                                     lamp(spot(35.0), dvec3(1.9, 2.1, -0.7), dvec3(-1.9, -1.9, 0.7)),
                                     lamp(sun(), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 2048)};
  set("shadows.filter", "hard");
  const TracedVisibility traced = trace(1);
  std::vector<Shares> oriented, hardware;
  for (const char* mm : {"0", "0.5", "2", "5", "10", "20"}) {
    set("shadows.bias_mm", mm);
    oriented.push_back(shares(lamps, traced, std::string("oriented ") + mm + " mm"));
  }
  set("shadows.bias", "hardware");
  for (const char* units : {"0", "200", "2000", "50000", "1000000"}) {
    set("shadows.bias_units", units);
    hardware.push_back(shares(lamps, traced, std::string("hardware ") + units + " units"));
  }
  const Shares& normal = oriented[2];
  EXPECT_LE(normal.acne, test::kMostWrong);
  EXPECT_LE(normal.leak, test::kMostWrong);
  const auto less = [](const Shares& a, const Shares& b) { return a.wrong < b.wrong; };
  EXPECT_LE(std::ranges::min_element(oriented, less)->wrong, 0.8 * std::ranges::min_element(hardware, less)->wrong);
  // At equal acne, with a tolerance of three pixels.
  for (const Shares& h : hardware) {
    double leak = 1.0;
    for (const Shares& o : oriented)
      if (o.acne <= h.acne + 1e-4) leak = std::min(leak, o.leak);
    EXPECT_LE(leak, h.leak) << "at acne of " << h.acne;
  }
}

TEST_F(ShadowBias, sixteen_bits_and_simplified_casters_have_no_acne_either) {
  yard();
  const std::vector<Entity> lamps = {lamp(point(), dvec3(-1.3, 1.9, 1.1)),
                                     lamp(spot(35.0), dvec3(1.9, 2.1, -0.7), dvec3(-1.9, -1.9, 0.7)),
                                     lamp(sun(), dvec3(0.0), dvec3(0.5, -0.6, -0.4))};
  const TracedVisibility traced = trace(1);
  for (const auto& [knob, value, usual] :
       {std::tuple{"shadows.depth", "d16", "d32"}, {"shadows.casters", "simplified", "full"}}) {
    set(knob, value);
    EXPECT_LE(shares(lamps, traced, value).acne, test::kMostWrong) << value;
    set(knob, usual);
  }
}

TEST_F(ShadowBias, a_wall_that_light_grazes_is_lit_and_dark_behind_a_roof) {
  thing(test::quad(1.0f, stone));
  box(dvec3(0.0, 1.5, 0.1), dvec3(0.45, 0.02, 0.3));
  settings = test::look_at(dvec3(0.2, 0.3, 2.6), dvec3(0.0), 96, 54);
  const Entity day = lamp(sun(), dvec3(0.0)), bulb = lamp(point(), dvec3(0.0));
  const std::vector<Entity> lamps = {day, bulb};
  for (const double degrees : {0.1, 0.5, 3.0}) {
    // Where at most 1/255 of the light falls on the wall, leaks are invisible.
    const bool seen = std::sin(glm::radians(degrees)) > 1.0 / 255.0;
    const double slope = std::tan(glm::radians(degrees));
    place(day, test::turn_towards(dvec3(0.0, -1.0, -slope)));
    place(bulb, at(0.0, 4.0, 4.0 * slope));
    const TracedVisibility traced = trace(1);
    for (const char* filter : {"hard", "chs"}) {
      set("shadows.filter", filter);
      for (const Entity lamp : lamps) {
        const std::string what =
            std::string(filter) + (lamp == day ? " sun" : " bulb") + " at " + std::to_string(degrees);
        const ShadowError e = error(lamp, traced);
        print(what, e);
        EXPECT_GT(e.pairs, 1500u) << what;
        EXPECT_LE(e.acne_share(), test::kMostWrong) << what;
        if (seen) {
          EXPECT_LE(e.leak_share(), test::kMostWrong) << what;
        }
      }
    }
  }
}

// Hard case: shadows.grazing_light
TEST_F(ShadowBias, a_flat_floor_in_grazing_light_has_no_acne_with_any_filter) {
  floor(12.0f);
  box(dvec3(0.0, 0.5, -11.0), dvec3(0.5));  // outside the picture
  settings = test::look_at(dvec3(7.5, 1.2, 2.0), dvec3(7.0, 0.0, 0.0), 96, 54);
  // Lights 0.1 degrees above the floor; no part of an emitter is below it.
  const double slope = std::tan(glm::radians(0.1));
  const std::vector<Entity> lamps = {lamp(point(0.01f), dvec3(0.0, 7.0 * slope, 0.0)),
                                     lamp(spot(20.0, 0.01f), dvec3(0.0, 7.0 * slope, 0.0), dvec3(1.0, -slope, 0.0)),
                                     lamp(sun(0.001f), dvec3(0.0), dvec3(1.0, -slope, 0.0))};
  using Knobs = std::vector<std::pair<const char*, const char*>>;
  for (const Knobs& knobs :
       {Knobs{{"filter", "hard"}}, Knobs{{"filter", "pcf"}, {"kernel", "16"}}, Knobs{{"filter", "pcss"}},
        Knobs{{"filter", "chs"}}, Knobs{{"filter", "chs"}, {"mip_operator", "nearest"}},
        Knobs{{"filter", "chs"}, {"mip_operator", "average"}}}) {
    // All other knobs have the values that ship.
    for (const char* knob : {"shadows.filter", "shadows.kernel", "shadows.mip_operator", "shadows.early_outs"}) {
      const Knob* found = renderer->knobs().find(knob);
      ASSERT_NE(found, nullptr) << knob;
      set(knob, value_text(*found, found->default_number));
    }
    std::string what;
    for (const auto& [knob, value] : knobs) {
      set(std::string("shadows.") + knob, value);
      what += std::string(knob) + "=" + value + " ";
    }
    for (const Entity lamp : lamps) {
      const std::vector<float> seen = visibility(lamp);
      double missing = 0.0;
      std::size_t reached = 0, acne = 0;
      for (const float v : seen) {
        if (v < 0.0f) continue;
        ++reached;
        missing += 1.0 - static_cast<double>(v);
        acne += v < 0.5f ? 1 : 0;
      }
      std::printf("%-28s %s: %zu reached, %zu acne, mean %.4f\n", what.c_str(), name_of(lamp).c_str(), reached, acne,
                  missing / static_cast<double>(reached));
      EXPECT_GT(reached, 2000u) << what << name_of(lamp);
      EXPECT_EQ(acne, 0u) << what << name_of(lamp);
      EXPECT_LE(missing, test::kMostMean * static_cast<double>(reached)) << what << name_of(lamp);
    }
  }
}

/// A sheet without thickness, 3 mm above a floor, at 1.8 mm per pixel.
class ThinSheet : public ShadowBias {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(ShadowBias::SetUp());
    if (IsSkipped()) return;
    floor(2.0f);
    Material both = exact_material(180, 170, 160, 255, 0);
    both.double_sided = true;
    const std::uint32_t double_sided = scene.material(both);
    const dmat4 lies = flat(0.003);
    variants = {
        {"facing up", stone, lies},
        {"facing down", stone, glm::rotate(lies, glm::radians(180.0), dvec3(1.0, 0.0, 0.0))},
        {"mirrored", stone, glm::scale(lies, dvec3(-1.0, 1.0, 1.0))},
        {"double-sided", double_sided, lies},
        {"double-sided, facing down", double_sided, glm::rotate(lies, glm::radians(180.0), dvec3(1.0, 0.0, 0.0))},
        {"double-sided, mirrored", double_sided, glm::scale(lies, dvec3(1.0, -1.0, 1.0))}};
    settings.camera.orthographic = true;
    settings.camera.half_height_m = 0.05f;
    settings.camera.half_width_m = 0.05f * 96.0f / 54.0f;
  }
  struct Variant {
    const char* name;
    std::uint32_t material;
    dmat4 matrix;
  };
  /// Excludes the pixels at the sheet's border with the sky, which may show either.
  [[nodiscard]] static TracedVisibility without_border(const TracedVisibility& traced) {
    TracedVisibility inner = traced;
    for (std::uint32_t layer = 0; layer < traced.lights.size(); ++layer)
      for (std::uint32_t y = 0; y < traced.height; ++y)
        for (std::uint32_t x = 0; x < traced.width; ++x) {
          const auto pixel = [&](std::uint32_t px, std::uint32_t py) {
            return layer * traced.pixels() + std::size_t{py} * traced.width + px;
          };
          bool border = false;
          for (std::uint32_t py = y - std::min(y, 1u); py <= std::min(y + 1, traced.height - 1); ++py)
            for (std::uint32_t px = x - std::min(x, 1u); px <= std::min(x + 1, traced.width - 1); ++px)
              border = border || !traced.is_judged(pixel(px, py));
          const std::size_t own = pixel(x, y);
          if (border) inner.judged[own / 8] &= static_cast<std::uint8_t>(~(1u << (own % 8)));
        }
    return inner;
  }
  std::vector<Variant> variants;
};

// Hard case: shadows.sheet_present, shadows.sheet_mirrored, shadows.sheet_double_sided
TEST_F(ThinSheet, shadows_the_floor_beside_it_in_slanting_light_whichever_side_it_shows) {
  // From 6 degrees above the floor, the shadow reaches 28 mm beyond the sheet's edge at z = −0.2; the edge at z = 0.2
  // casts none.
  const double slope = std::tan(glm::radians(6.0));
  const Entity slanting = lamp(spot(6.0), dvec3(0.0, 3.0 * slope, 2.8), dvec3(0.0, -slope, -1.0), 2048);
  for (const Variant& variant : variants) {
    const Entity sheet = thing(test::quad(0.2f, variant.material), variant.matrix);
    for (const double edge : {-0.2, 0.2}) {
      settings.world_from_camera =
          test::look_at(dvec3(0.02, 1.0, edge + 0.4), dvec3(0.02, 0.0, edge), 96, 54).world_from_camera;
      const TracedVisibility traced = trace(1);
      for (const char* filter : {"hard", "chs"}) {
        set("shadows.filter", filter);
        const std::string what = std::string(variant.name) + " " + filter + (edge < 0.0 ? " far" : " near");
        expect_right(what, error(slanting, traced), 4000);
        std::size_t dark = 0;
        for (const std::uint8_t v : traced.layer(*traced.layer_of(slanting))) dark += v == 0 ? 1 : 0;
        EXPECT_GE(dark, edge < 0.0 ? 900u : 0u) << what;
      }
    }
    place(sheet, at(0.0, -50.0, 0.0));
  }
}

// Hard case: shadows.sheet_no_leak, shadows.sheet_mirrored, shadows.sheet_double_sided
TEST_F(ThinSheet, leaks_no_light_into_the_gap_below_it) {
  // The camera is inside the gap and looks at the floor near the sheet's edge, under a light straight above.
  const Entity above = lamp(spot(10.0), dvec3(0.0, 2.0, 0.0), dvec3(0.0, -1.0, 0.0), 2048);
  const Entity slanting = lamp(spot(10.0), dvec3(0.9, 1.8, -0.3), dvec3(-0.9, -1.8, 0.3), 2048);
  settings = test::look_at(dvec3(0.0, 0.0015, -0.15), dvec3(0.0, 0.0009, -0.17), 96, 54);
  settings.camera.near_m = 0.0002f;
  for (const Variant& variant : variants) {
    const Entity sheet = thing(test::quad(0.2f, variant.material), variant.matrix);
    const TracedVisibility traced = trace(1);
    for (const Entity lamp : {above, slanting})
      for (const char* filter : {"hard", "chs"}) {
        set("shadows.filter", filter);
        const std::string what =
            std::string(variant.name) + " gap " + filter + (lamp == above ? " above" : " slanting");
        const ShadowError e = error(lamp, traced);
        print(what, e);
        EXPECT_EQ(e.leaks, 0u) << what;
        EXPECT_EQ(e.acne, 0u) << what;
        EXPECT_LE(e.mean(), test::kMostMean) << what;
        std::size_t dark = 0;
        for (const std::uint8_t v : traced.layer(*traced.layer_of(lamp))) dark += v == 0 ? 1 : 0;
        EXPECT_GT(dark, 1000u) << what;
      }
    place(sheet, at(0.0, -50.0, 0.0));
  }
}

TEST_F(ThinSheet, has_a_dark_side_however_the_light_slants) {
  // An upright square of 0.4 m, and lamps 1.5 m behind it; at 0 degrees straight behind.
  Material both = exact_material(180, 170, 160, 255, 0);
  both.double_sided = true;
  thing(test::quad(0.2f, scene.material(both)), at(0.0, 1.0, 0.0));
  settings.camera.half_height_m = 0.15f;
  settings.camera.half_width_m = 0.15f * 96.0f / 54.0f;
  settings.world_from_camera = test::look_at(dvec3(0.0, 1.0, 1.0), dvec3(0.0, 1.0, 0.0), 96, 54).world_from_camera;
  set("shadows.filter", "hard");
  for (const double degrees : {0.0, 30.0, 45.0, 60.0, 70.0, 80.0, 85.0}) {
    const double angle = glm::radians(degrees);
    const Entity behind = lamp(point(), dvec3(1.5 * std::sin(angle), 1.0, -1.5 * std::cos(angle)));
    const ShadowError e = error(behind, without_border(trace(1)));
    print("dark side, " + std::to_string(static_cast<int>(degrees)) + " degrees", e);
    EXPECT_EQ(e.leaks, 0u) << degrees << " degrees, of " << e.pairs;
    world.get<Light>(behind).intensity = 0.0f;
  }
}

TEST_F(ThinSheet, in_the_air_is_lit_on_one_side_and_dark_on_the_other) {
  const Entity above = lamp(point(), dvec3(0.3, 2.0, 0.2));
  settings.camera.half_height_m = 0.3f;
  settings.camera.half_width_m = 0.3f * 96.0f / 54.0f;
  std::size_t judged = 0;
  for (const Variant& variant : variants) {
    const Entity sheet = thing(test::quad(0.2f, variant.material), at(0.0, 1.0, 0.0) * variant.matrix);
    for (const double side : {1.0, -1.0}) {
      settings.world_from_camera =
          test::look_at(dvec3(0.1, 1.0 + 0.5 * side, 0.5), dvec3(0.0, 1.0, 0.0), 96, 54).world_from_camera;
      const TracedVisibility traced = trace(1);
      if (!traced.layer_of(above)) continue;  // a single-sided sheet, lit from behind
      ++judged;
      const std::string what = std::string(variant.name) + (side > 0.0 ? " from above" : " from below");
      const ShadowError e = error(above, without_border(traced));
      print(what, e);
      EXPECT_EQ(e.wrong, 0u) << what;
    }
    place(sheet, at(0.0, -50.0, 0.0));
  }
  EXPECT_GT(judged, std::size(variants)) << "a sheet is seen from its lit side at least";
}

// Hard case: shadows.normal_quantisation
TEST_F(ShadowBias, a_wall_in_line_with_the_sun_is_lit_as_without_shadows) {
  const Entity wall = thing(test::quad(1.5f, stone));
  box(dvec3(-3.0, 0.0, 0.3), dvec3(0.2));  // gives the casters' bounds some depth
  settings = test::look_at(dvec3(0.2, 0.3, 2.5), dvec3(0.0), 96, 54);
  lamp(sun(), dvec3(0.0), dvec3(0.0, -0.3, -1.0));
  const double full = test::LitSceneTest::pixel(drawn(), 48, 27).x;
  ASSERT_GT(full, 0.1);
  for (const double tilt : {-1e-3, -1e-4, -1e-5, 0.0, 1e-5, 1e-4, 1e-3}) {
    // Turns the wall until it is parallel to the sun's rays.
    place(wall, glm::rotate(dmat4(1.0), std::atan2(1.0, 0.3) - glm::radians(180.0) + tilt, dvec3(1, 0, 0)));
    settings = test::look_at(dvec3(0.2, 2.5, 0.4), dvec3(0.0), 96, 54);
    set("shadows.mode", "monolithic");
    const LinearPicture with = drawn();
    expect_finite("in line");
    set("shadows.mode", "off");
    const LinearPicture without = drawn();
    double worst = 0.0;
    for (std::size_t i = 0; i < with.rgba.size(); ++i)
      worst = test::worse(worst, std::abs(static_cast<double>(with.rgba[i]) - static_cast<double>(without.rgba[i])));
    EXPECT_LE(worst, 2e-3 * full) << tilt;
  }
}

}  // namespace
}  // namespace gloam
