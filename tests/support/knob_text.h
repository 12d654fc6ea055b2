// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "engine/render/knobs/knobs.h"

namespace gloam::test {

/// Current value of a knob by its name; fails the test if there is none. KnobRegistry reads by typed reference only.
[[nodiscard]] inline double knob_number(const KnobRegistry& knobs, std::string_view name) {
  const Knob* knob = knobs.find(name);
  EXPECT_NE(knob, nullptr) << name;
  return knob == nullptr ? 0.0 : knobs.number(*knob);
}

[[nodiscard]] inline std::string knob_text(const KnobRegistry& knobs, std::string_view name) {
  const Knob* knob = knobs.find(name);
  EXPECT_NE(knob, nullptr) << name;
  return knob == nullptr ? std::string() : knobs.text(*knob);
}

}  // namespace gloam::test
