// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/measures.h"

#include <gtest/gtest.h>

#include "engine/render/reference/reference.h"
#include "modules/shadows/module.h"

namespace gloam {
namespace {

TEST(ShadowMeasures, classifying_counts_the_pairs_whose_pixels_are_still_asked) {
  const MeasureInfo measure = shadow_measures().front();
  EXPECT_EQ(measure.knob, "shadows.classify");
  const FrameCounters off = {{"shadows.tile_lights", 200.0}, {"shadows.tile_lights_filtered", 200.0}};
  const FrameCounters on = {{"shadows.tile_lights", 200.0}, {"shadows.tile_lights_filtered", 50.0}};
  EXPECT_EQ(measure.error(off, on), 1.0);
  EXPECT_EQ(measure.error(on, on), 0.25);
  EXPECT_EQ(measure.error({}, on), std::nullopt) << "no final lists";
  EXPECT_EQ(measure.error({{"shadows.tile_lights", 0.0}, {"shadows.tile_lights_filtered", 0.0}}, on), std::nullopt);
  EXPECT_EQ(measure.fault(on), "");
}

/// The ledger sets the knobs that a measure names: they must exist, and no knob may have two measures.
TEST(ShadowMeasures, name_knobs_and_values_that_exist) {
  const auto module = make_shadows_module();
  KnobRegistry knobs;
  module->knobs(knobs);
  ASSERT_EQ(module->measures().size(), 1u);
  for (const MeasureInfo& measure : module->measures()) {
    EXPECT_NE(knobs.find(measure.knob), nullptr) << measure.knob;
    for (const auto* list : {&measure.judged_with, &measure.picture})
      for (const auto& [name, value] : *list) EXPECT_TRUE(knobs.set(name, value).ok()) << name << " " << value;
    for (const ReferenceInfo& reference : module->references()) EXPECT_NE(reference.knob, measure.knob);
  }
}

}  // namespace
}  // namespace gloam
