// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/knob_overrides.h"

#include "engine/core/assert.h"

namespace gloam {

KnobOverrides::~KnobOverrides() {
  for (auto before = before_.rbegin(); before != before_.rend(); ++before) {
    const Status restored = knobs_.set(before->name, before->value);
    GLOAM_ASSERT(restored.ok(), "a knob's own value can be set");
  }
}

Status KnobOverrides::set(std::span<const KnobOverride> overrides) {
  for (const KnobOverride& knob : overrides) {
    const Knob* known = knobs_.find(knob.name);
    const std::string before = known != nullptr ? knobs_.text(*known) : std::string();
    // A set counts as a change for observers of the knobs, even with the same value.
    if (known != nullptr && knob.value == before) continue;
    GLOAM_TRY(knobs_.set(knob.name, knob.value));
    before_.push_back({knob.name, before});
  }
  return {};
}

}  // namespace gloam
