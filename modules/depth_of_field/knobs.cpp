// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/knobs.h"

#include <utility>

#include "shaders/depth_of_field/depth_of_field_shared.h"

namespace gloam {
namespace {

Knob dof_knob(std::string name, std::string meaning) {
  Knob knob;
  knob.name = std::move(name);
  knob.module = "depth_of_field";
  knob.meaning = std::move(meaning);
  return knob;
}

}  // namespace

void add_dof_knobs(KnobRegistry& registry) {
  Knob cache = dof_knob("dof.cache",
                        "workgroup memory of the blur: not used (none), one array of vectors (vec4), or one array for "
                        "each channel (channels); the picture is the same");
  cache.choices = {"none", "vec4", "channels"};
  registry.add(cache);
  Knob radius = dof_knob("dof.radius", "greatest radius of a circle of confusion, in pixels of the picture");
  radius.type = Knob::Type::number;
  radius.min = 3;
  radius.max = GLOAM_DOF_MOST_RADIUS;
  radius.default_number = 15;
  radius.unit = "pixels";
  radius.ledger_values = {3, 7, 15, 23, 31};
  registry.add(radius);
  Knob resolution = dof_knob("dof.resolution", "size of the images that are blurred, relative to the picture");
  resolution.choices = {"half", "full"};
  registry.add(resolution);
}

DofKnobs dof_knobs(const KnobRegistry& registry) {
  DofKnobs knobs;
  knobs.cache = static_cast<DofKnobs::Cache>(registry.choice("dof.cache"));
  knobs.radius = static_cast<float>(registry.number("dof.radius"));
  knobs.full_resolution = registry.is("dof.resolution", "full");
  return knobs;
}

}  // namespace gloam
