// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/entity.h"

namespace gloam {

/// This entity's subtree is a close-up subject.
struct CloseupSubject {
  bool enabled = false;
  float priority = 1.0f;     ///< order when the budget is short
  std::uint32_t lights = 0;  ///< comma-separated light names in SceneStrings; 0: every shadowed light that reaches it
};

/// One subject lit by one light, with a shadow map of its own. Made by a system.
struct CloseupPair {
  Entity subject;
  Entity light;
};

}  // namespace gloam
