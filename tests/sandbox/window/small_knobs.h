// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/knobs/knobs.h"

namespace gloam::test {

/// A registry with one knob of each type.
[[nodiscard]] inline KnobRegistry small_knobs() {
  KnobRegistry registry;
  registry.add({.name = "lamp.filter",
                .module = "lamp",
                .meaning = "how shadows are filtered",
                .type = Knob::Type::choice,
                .choices = {"none", "box", "tent"},
                .default_number = 1.0,
                .exact = "tent"});
  registry.add({.name = "lamp.samples",
                .module = "lamp",
                .meaning = "rays a pixel",
                .type = Knob::Type::integer,
                .min = 1.0,
                .max = 256.0,
                .default_number = 16.0});
  registry.add({.name = "lamp.share",
                .module = "lamp",
                .meaning = "of the light that is kept",
                .type = Knob::Type::number,
                .min = 0.0,
                .max = 50.0,
                .default_number = 12.5,
                .unit = "%"});
  return registry;
}

}  // namespace gloam::test
