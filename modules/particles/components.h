// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

enum class EmitterKind : std::uint8_t { none, fog, dust, smoke, fire };

/// Emits particles from a box around the node. Each is born where the node was at that time, from animations or as the
/// world has noted it (emitters/path.h). A host that puts the node elsewhere at once lists it in Teleports.
struct ParticleEmitter {
  EmitterKind kind = EmitterKind::none;
  float rate = 20.0f;  ///< 1/s
  float lifetime_s = 2.0f;
  float size_m = 0.3f;
  float speed = 0.5f;          ///< m/s
  float spread = 0.34906585f;  ///< half angle around +Y, radians
  vec3 box_m = vec3(1.0f);
  float metres_per_unit = 1.0f;  ///< scales how its kind moves; sizes and speed above are in units; > 0
};

}  // namespace gloam
