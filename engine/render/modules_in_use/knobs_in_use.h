// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "engine/render/knobs/knobs.h"
#include "engine/render/modules_in_use/module_set.h"

namespace gloam {

/// The knobs of a renderer: the values that were set, and those that frames are drawn with.
struct KnobsInUse {
  KnobRegistry set;
  /// The last values whose pipelines were ready; only with Readiness::background.
  std::optional<KnobRegistry> settled;
  std::uint64_t drawn_version = 0;  ///< KnobRegistry::version of the values that the last frame was drawn with

  /// The knobs of the next frame. With Readiness::background, changed values wait until the pipelines of all modules
  /// that the last frame showed are ready: until then the old ones stay.
  [[nodiscard]] const KnobRegistry& settle(const ModuleSet& modules, const PipelineWait& wait);

 private:
  [[nodiscard]] const KnobRegistry& settle_in_background(const ModuleSet& modules, const PipelineWait& wait);
};

}  // namespace gloam
