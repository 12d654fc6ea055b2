// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

using ShadowKnobValues = test::HardShadows;

// Hard case: shadows.all_finite
TEST_F(ShadowKnobValues, draw_numbers_whichever_they_are) {
  static_cast<void>(fill(world));
  settings.width = 48;
  settings.height = 32;
  const std::vector<Knob> knobs = renderer->knobs().knobs();
  std::size_t values = 0;
  for (const Knob& knob : knobs) {
    if (knob.module != "shadows") continue;
    std::vector<std::string> texts = knob.choices;
    if (texts.empty())
      for (const double number : {knob.min, knob.default_number, knob.max}) texts.push_back(value_text(knob, number));
    for (const std::string& text : texts) {
      set(knob.name, text);
      draw();
      expect_finite(knob.name + "=" + text);
      ++values;
    }
    set(knob.name, value_text(knob, knob.default_number));
  }
  EXPECT_GE(values, 30u);
  EXPECT_TRUE(warnings.empty());
}

}  // namespace
}  // namespace gloam
