// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/display/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gloam {
namespace {

TEST(Exposure, of_an_exposure_value_makes_the_saturation_luminance_white) {
  // Lagarde and de Rousiers 2014: L_max = 1.2 · 2^EV100 cd/m².
  EXPECT_FLOAT_EQ(exposure_from_ev100(0.0f), 1.0f / 1.2f);
  EXPECT_FLOAT_EQ(exposure_from_ev100(15.0f), 1.0f / (1.2f * 32768.0f));
  EXPECT_FLOAT_EQ(exposure_from_ev100(-3.0f), 8.0f / 1.2f);
  for (const float ev : {-100.0f, -50.0f, 50.0f, 100.0f}) {
    EXPECT_GT(exposure_from_ev100(ev), 0.0f);
    EXPECT_TRUE(std::isfinite(exposure_from_ev100(ev)));
  }
}

}  // namespace
}  // namespace gloam
