// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/modules/shadows/support/hard_shadows.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

/// Cascades of directional lights.
class ShadowSun : public test::HardShadows {
 protected:
  /// Greatest mean difference over a row of pixels.
  [[nodiscard]] double worst_row(Entity lamp, const TracedVisibility& traced) {
    const std::vector<float> seen = visibility(lamp);
    double worst = 0.0;
    for (std::uint32_t y = 0; y < traced.height; ++y) {
      double sum = 0.0;
      std::uint32_t count = 0;
      for (std::uint32_t x = 0; x < traced.width; ++x) {
        const std::size_t i = std::size_t{y} * traced.width + x;
        if (!traced.is_judged(i)) continue;
        sum += std::abs(static_cast<double>(seen[i]) - traced.visibility[i] / 255.0);
        ++count;
      }
      if (count >= traced.width / 2) worst = test::worse(worst, sum / count);
    }
    return worst;
  }
};

TEST_F(ShadowSun, cascades_have_no_seams_along_a_shadow_that_runs_through_all_of_them) {
  thing(test::quad(40.0f, stone), at(0.0, 0.0, -30.0) * flat(0.0));
  box(dvec3(-2.0, 0.5, -25.0), dvec3(0.05, 0.5, 27.0));
  const Entity low = lamp(sun(), dvec3(0.0), dvec3(1.0, -1.0, 0.1));
  settings = test::look_at(dvec3(0.0, 1.5, 3.0), dvec3(-1.2, 0.0, -8.0), 160, 90);
  draw();
  EXPECT_GE(counter("shadows.faces_drawn") + counter("shadows.faces_skipped"), 3.0);
  for (const float angle : {0.0f, 0.1f}) {
    world.get<Light>(low).apparent_angle = angle;
    const TracedVisibility traced = trace(angle > 0.0f ? 64 : 1);
    for (const char* filter : {"hard", "pcss"}) {
      if ((angle > 0.0f) != (std::string(filter) == "pcss")) continue;
      set("shadows.filter", filter);
      const ShadowError e = error(low, traced);
      expect_right(std::string("sun of ") + std::to_string(angle) + " rad, " + filter, e, 5000);
      // A row crosses three edges, each with an error of up to a pixel.
      const double row = worst_row(low, traced);
      std::printf("worst row: %.4f\n", row);
      EXPECT_LE(row, angle > 0.0f ? test::kMostPenumbraMean : 3.5 / traced.width) << filter;
    }
  }
}

TEST_F(ShadowSun, shadows_do_not_crawl_while_the_camera_moves_by_less_than_a_texel) {
  yard();
  box(dvec3(3.0, 0.3, 2.0), dvec3(0.3));
  const Entity low = lamp(sun(0.05f), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 128);
  settings = test::look_at(dvec3(0.0, 3.0, 3.0), dvec3(0.0), 96, 54);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.0f;
  settings.camera.half_width_m = 96.0f / 54.0f;
  const dmat4 begin = settings.world_from_camera;
  const double pixel = 2.0 / 54.0;
  for (const char* filter : {"hard", "chs"}) {
    set("shadows.filter", filter);
    settings.world_from_camera = begin;
    const std::vector<float> first = visibility(low);
    for (std::uint32_t step = 1; step <= 6; ++step) {
      settings.world_from_camera = begin;
      settings.world_from_camera[3].x += pixel * step;
      const std::vector<float> moved = visibility(low);
      double sum = 0.0, worst = 0.0;
      std::size_t count = 0, flips = 0;
      for (std::uint32_t y = 0; y < settings.height; ++y)
        for (std::uint32_t x = 0; x + step < settings.width; ++x) {
          const double off = std::abs(static_cast<double>(moved[y * settings.width + x]) -
                                      static_cast<double>(first[y * settings.width + x + step]));
          sum += off;
          worst = std::max(worst, off);
          flips += off > 0.25 ? 1 : 0;
          ++count;
        }
      std::printf("%s moved by %u pixels: mean %.5f, worst %.3f, %zu of %zu by more than a quarter\n", filter, step,
                  sum / static_cast<double>(count), worst, flips, count);
      EXPECT_LE(sum, 0.002 * static_cast<double>(count)) << filter << " " << step;
      EXPECT_LE(static_cast<double>(flips), 0.002 * static_cast<double>(count)) << filter << " " << step;
    }
  }
}

// Hard case: further.sun_zenith, further.sun_nadir, further.sun_horizon
TEST_F(ShadowSun, along_the_axes_casts_right_shadows) {
  yard();
  const Entity day = lamp(sun(), dvec3(0.0));
  for (const dvec3& direction : {dvec3(0.0, -1.0, 0.0), dvec3(0.0, -1.0, -1.0), dvec3(1.0, -1.0, 0.0)}) {
    place(day, test::turn_towards(direction));
    expect_right("sun along an axis", day);
  }
  // Directions parallel to the floor, from below, and undefined.
  for (const dmat4& turn : {test::turn_towards(dvec3(1.0, 0.0, 0.0)), test::turn_towards(dvec3(0.0, 1.0, 0.0)),
                            glm::scale(dmat4(1.0), dvec3(0.0)), dmat4(std::numeric_limits<double>::quiet_NaN())}) {
    place(day, turn);
    draw();
    expect_finite("a sun that lights nothing");
  }
}

}  // namespace
}  // namespace gloam
