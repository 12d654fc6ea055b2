// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/knob_overrides.h"

#include "engine/core/assert.h"

namespace gloam {

KnobOverrides::~KnobOverrides() {
  for (auto before = before_.rbegin(); before != before_.rend(); ++before) {
    const Status restored = knobs_.set(before->first, before->second);
    GLOAM_ASSERT(restored.ok(), "a knob's own value can be set");
  }
}

Status KnobOverrides::set(std::span<const std::string> assignments) {
  for (const std::string& assignment : assignments) {
    const std::string name = assignment.substr(0, assignment.find('='));
    const bool exists = knobs_.find(name) != nullptr;
    const std::string before = exists ? knobs_.text(name) : std::string();
    // A set counts as a change for observers of the knobs, even with the same value.
    if (exists && assignment == name + "=" + before) continue;
    GLOAM_TRY(knobs_.set_assignment(assignment));
    before_.emplace_back(name, before);
  }
  return {};
}

}  // namespace gloam
