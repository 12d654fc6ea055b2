// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/lighting/display/tone_reference.h"

namespace gloam {
namespace {

TEST(ToneCurve, of_agx_rises_from_black_to_white) {
  EXPECT_LT(tone_mapped(ToneCurve::agx, dvec3(0.0)).x, 1e-12);
  EXPECT_NEAR(tone_mapped(ToneCurve::agx, dvec3(17.0)).x, 1.0, 1e-9);
  double last = -1.0;
  for (double stops = -9.9; stops < 6.4; stops += 0.01) {
    const double shown = tone_mapped(ToneCurve::agx, dvec3(0.18 * std::exp2(stops))).y;
    ASSERT_GT(shown, last) << stops;
    last = shown;
  }
}

TEST(ToneCurve, of_agx_keeps_greys_and_shows_middle_grey_as_filmic_does) {
  for (const double x : {1e-4, 0.01, 0.18, 1.0, 7.0}) {
    const dvec3 shown = tone_mapped(ToneCurve::agx, dvec3(x));
    EXPECT_NEAR(shown.x, shown.y, 1e-12);
    EXPECT_NEAR(shown.y, shown.z, 1e-12);
  }
  EXPECT_NEAR(tone_mapped(ToneCurve::agx, dvec3(0.18)).x, tone_mapped(ToneCurve::filmic, dvec3(0.18)).x, 1e-3);
}

TEST(ToneCurve, of_agx_fades_bright_colours_to_white) {
  double last = 2.0;
  for (const double x : {0.5, 2.0, 8.0, 32.0, 128.0}) {
    const dvec3 shown = tone_mapped(ToneCurve::agx, x * dvec3(1.0, 0.02, 0.1));
    const double purity = 1.0 - std::min(shown.y, shown.z) / shown.x;
    EXPECT_LT(purity, last + 1e-12) << x;
    last = purity;
  }
  EXPECT_LT(last, 0.05);
  EXPECT_GT(tone_mapped(ToneCurve::agx, dvec3(0.2, 0.004, 0.02)).x,
            3.0 * tone_mapped(ToneCurve::agx, dvec3(0.2, 0.004, 0.02)).y)
      << "dim colours keep their purity";
}

}  // namespace
}  // namespace gloam
