// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"
#include "modules/closeups/pairs/views.h"

namespace gloam {

struct CloseupKnobs {
  std::uint32_t max_pairs = 8;
  float texels_per_pixel = 1.0f;
  std::uint32_t batch = 1;
  bool single_fetches = true;   ///< of maps; else as standard maps are looked at
  bool draws_standard = false;  ///< what forward-lit things see of a subject is drawn, not transferred
};

void add_closeup_knobs(KnobRegistry& registry);
[[nodiscard]] CloseupKnobs closeup_knobs(const KnobRegistry& registry);
[[nodiscard]] CloseupSettings closeup_settings(const CloseupKnobs& knobs, bool enabled);

}  // namespace gloam
