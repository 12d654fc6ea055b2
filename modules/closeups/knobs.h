// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

/// Values of this module's knobs.
struct CloseupKnobs {
  std::uint32_t max_pairs = 8;
  float texels_per_pixel = 1.0f;
  std::uint32_t batch = 1;      ///< pairs that share the close-up map at a time: 1, 2 or 4
  bool single_fetches = true;   ///< filter of close-up maps: single fetches; false: the filter of standard maps
  bool draws_standard = false;  ///< true: subjects are drawn into the overlay; false: transferred from the close-up map
};

void add_closeup_knobs(KnobRegistry& registry);
[[nodiscard]] CloseupKnobs closeup_knobs(const KnobRegistry& registry);
/// `enabled`: shadows.mode = deferred. The settings are disabled as well if max_pairs is 0.
[[nodiscard]] CloseupSettings closeup_settings(const CloseupKnobs& knobs, bool enabled);

}  // namespace gloam
