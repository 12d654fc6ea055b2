// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/reduced_knobs.h"

#include <gtest/gtest.h>

#include <string>

#include "modules/module_list/module_list.h"
#include "sandbox/session/program_knobs.h"

namespace gloam {
namespace {

constexpr const char* kDensity = "shadows.texels_per_pixel";
constexpr const char* kDirections = "shadows.near_directions";

TEST(ReducedKnobs, maps_are_coarser_below_half_the_size_and_at_least_half_as_dense) {
  const KnobRegistry knobs = all_knobs(make_all_modules());
  EXPECT_TRUE(knobs_at_scale(knobs, 1.0).empty());
  EXPECT_TRUE(knobs_at_scale(knobs, 0.5).empty());
  double above = knobs.find(kDensity)->default_number;
  for (const double scale : {0.42, 0.35, 0.3, 0.25}) {
    const auto reduced = knobs_at_scale(knobs, scale);
    ASSERT_EQ(reduced.size(), 2u) << scale;
    KnobRegistry set = all_knobs(make_all_modules());
    for (const KnobOverride& knob : reduced) ASSERT_TRUE(set.set(knob.name, knob.value).ok()) << knob.value;
    EXPECT_EQ(set.text(*set.find(kDirections)), "8");
    const double density = set.number(*set.find(kDensity));
    EXPECT_LT(density, above) << scale;
    above = density;
  }
  EXPECT_DOUBLE_EQ(above, 0.5 * knobs.find(kDensity)->default_number);
}

TEST(ReducedKnobs, a_changed_knob_stays) {
  KnobRegistry knobs = all_knobs(make_all_modules());
  ASSERT_TRUE(knobs.set(kDensity, "2").ok());
  ASSERT_TRUE(knobs.set(kDirections, "32").ok());
  EXPECT_TRUE(knobs_at_scale(knobs, 0.25).empty());
}

}  // namespace
}  // namespace gloam
