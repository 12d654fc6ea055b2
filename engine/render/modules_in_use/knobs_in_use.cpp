// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/modules_in_use/knobs_in_use.h"

namespace gloam {

const KnobRegistry& KnobsInUse::settle(const ModuleSet& modules, const PipelineWait& wait) {
  if (wait.readiness == Readiness::wait) return set;
  if (settled && settled->version() == set.version()) return *settled;
  if (!settled || modules.shown_pipelines_ready(set, wait)) settled = set;
  return *settled;
}

}  // namespace gloam
