// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/knobs.h"

namespace gloam {

void add_closeup_knobs(KnobRegistry& registry) {
  add_knobs(registry, "closeups", kMostCloseupPairs, kCloseupTexelsPerPixel, kCloseupSingleFetches, kCloseupBatch,
            kCloseupDrawsStandard);
}

CloseupKnobs closeup_knobs(const KnobRegistry& registry) {
  CloseupKnobs knobs;
  knobs.max_pairs = registry.value(kMostCloseupPairs);
  knobs.texels_per_pixel = static_cast<float>(registry.value(kCloseupTexelsPerPixel));
  knobs.batch = registry.value(kCloseupBatch);
  knobs.single_fetches = registry.value(kCloseupSingleFetches);
  knobs.keeps_maps = registry.value(kShadowReuse) != ShadowReuse::off;
  knobs.draws_standard = registry.value(kCloseupDrawsStandard);
  return knobs;
}

CloseupSettings closeup_settings(const CloseupKnobs& knobs, bool enabled) {
  CloseupSettings settings;
  settings.enabled = enabled && knobs.max_pairs > 0;
  settings.max_pairs = knobs.max_pairs;
  settings.batch = knobs.batch;
  settings.texels_per_pixel = knobs.texels_per_pixel;
  return settings;
}

}  // namespace gloam
