// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/knobs_in_use.h"

namespace gloam {

const KnobRegistry& KnobsInUse::settle(const ModuleSet& modules, const PipelineWait& wait) {
  const bool waits = wait.readiness == Readiness::wait;
  if (waits && settled) settled->take_values(set);
  const KnobRegistry& drawn = waits ? set : settle_in_background(modules, wait);
  drawn_version = drawn.version();
  return drawn;
}

const KnobRegistry& KnobsInUse::settle_in_background(const ModuleSet& modules, const PipelineWait& wait) {
  if (!settled) {
    settled = set;
  } else if (settled->version() != set.version() && modules.shown_pipelines_ready(set, wait)) {
    settled->take_values(set);
  }
  return *settled;
}

}  // namespace gloam
