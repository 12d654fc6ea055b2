// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "engine/render/governor/frame_budget.h"
#include "engine/render/knobs/knobs.h"
#include "tests/support/knob_text.h"

// A front of three points over two knobs, and a third knob that no point names.

namespace gloam::test {

inline KnobRegistry budget_knobs() {
  KnobRegistry knobs;
  knobs.add({.name = "shadows.filter", .module = "shadows", .choices = {"hard", "pcf", "chs"}, .default_number = 2});
  knobs.add({.name = "views.scale",
             .module = "views",
             .type = Knob::Type::number,
             .min = 0.25,
             .max = 1.0,
             .default_number = 1.0});
  knobs.add({.name = "fog.radius",
             .module = "fog",
             .type = Knob::Type::number,
             .min = 1.0,
             .max = 6.0,
             .default_number = 2.0});
  return knobs;
}

/// 10, 20 and 40 ms.
inline std::vector<FrontPoint> three_points() {
  return {{.ms = 10.0, .error = 0.1, .settings = {{"shadows.filter", "hard"}, {"views.scale", "0.5"}}},
          {.ms = 20.0, .error = 0.02, .settings = {{"shadows.filter", "pcf"}}},
          {.ms = 40.0, .error = 0.0, .settings = {}}};
}

}  // namespace gloam::test
