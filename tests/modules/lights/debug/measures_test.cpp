// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/debug/measures.h"

#include <gtest/gtest.h>

#include <string>

#include "modules/lights/module.h"

namespace gloam {
namespace {

MeasureInfo measure_of(const std::string& knob) {
  for (MeasureInfo& measure : light_measures())
    if (measure.knob == knob) return measure;
  ADD_FAILURE() << "no measure of " << knob;
  return {};
}

const FrameCounters kTiled = {{"lights.local", 1000.0},
                              {"lights.per_tile_candidates_mean", 30.0},
                              {"lights.per_tile_accurate_mean", 12.5},
                              {"lights.capacity_violations", 0.0},
                              {"lights.culling_errors", 0.0}};
const FrameCounters kBrute = {{"lights.local", 1000.0}};

TEST(LightMeasures, bounds_and_bins_count_candidates_that_reach_no_pixel) {
  for (const char* knob : {"lights.tile_bound", "lights.z_bins"}) {
    const MeasureInfo measure = measure_of(knob);
    EXPECT_EQ(measure.error(kTiled, {}), 17.5) << knob;
    EXPECT_EQ(measure.error(kBrute, kTiled), std::nullopt) << knob << ": nothing is culled";
    EXPECT_EQ(measure.unit, "false positives a tile");
  }
}

TEST(LightMeasures, culling_counts_what_shading_loops_over_in_vain) {
  const MeasureInfo measure = measure_of("lights.culling");
  EXPECT_EQ(measure.error(kTiled, kTiled), 0.0);
  EXPECT_EQ(measure.error(kBrute, kTiled), 987.5);
  EXPECT_EQ(measure.error(kBrute, kBrute), std::nullopt) << "nobody knows what is exact";
}

TEST(LightMeasures, a_frame_that_lost_a_light_is_wrong) {
  const MeasureInfo measure = measure_of("lights.z_bins");
  EXPECT_EQ(measure.fault(kTiled), "");
  EXPECT_EQ(measure.fault(kBrute), "");
  FrameCounters lost = kTiled;
  lost["lights.capacity_violations"] = 2.0;
  EXPECT_EQ(measure.fault(lost), "2 lights found no room in their tile's list");
  lost["lights.culling_errors"] = 7.0;
  EXPECT_EQ(measure.fault(lost), "7 times a pixel is in range of a light that its tile's list lacks");
}

/// The ledger sets the knobs and values that a measure names, so they must exist.
TEST(LightMeasures, name_knobs_and_values_that_exist) {
  const auto module = make_lights_module();
  KnobRegistry knobs;
  module->knobs(knobs);
  ASSERT_EQ(module->measures().size(), 3u);
  for (const MeasureInfo& measure : module->measures()) {
    EXPECT_NE(knobs.find(measure.knob), nullptr) << measure.knob;
    for (const auto* list : {&measure.judged_with, &measure.picture})
      for (const auto& [name, value] : *list) EXPECT_TRUE(knobs.set(name, value).ok()) << name << " " << value;
  }
}

}  // namespace
}  // namespace gloam
