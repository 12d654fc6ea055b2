// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/entity.h"

namespace gloam {

/// This entity's subtree is a close-up subject.
struct CloseupSubject {
  bool enabled = false;
  float priority = 1.0f;  ///< higher first, when there are more pairs than closeups.max_pairs
  /// Comma-separated light names in SceneStrings; 0: every shadow-casting light that reaches the subject.
  std::uint32_t lights = 0;
};

/// One subject lit by one light, with its own shadow map. Created by system closeup_pairs.
struct CloseupPair {
  Entity subject;
  Entity light;
};

}  // namespace gloam
