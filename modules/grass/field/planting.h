// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The blades of one surface stay on it while its node moves: a patch is carried by the ground's matrix, so that nothing
// is grown again and the blades keep their knots.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/grass/components.h"

namespace gloam {

/// Motion of a patch with its ground in the last frame.
struct GrassPatchMotion {
  dvec3 carried = dvec3(0.0);                       ///< way of the origin since the frame before
  dquat previous_turn = dquat(1.0, 0.0, 0.0, 0.0);  ///< GrassPatch::turn of the frame before
  dvec3 velocity = dvec3(0.0);                      ///< of the origin, m/s
  vec3 push = vec3(0.0f);  ///< acceleration of the blades against that of the ground, at most kMostGroundPush
};
inline constexpr double kMostGroundPush = 30.0;  // m/s²

/// How the ground has moved since it was planted.
struct CarriedGround {
  dvec3 from = dvec3(0.0);  ///< world position of the mesh's origin when it was planted
  dvec3 to = dvec3(0.0);    ///< now
  bool turns = false;       ///< false: it was only shifted; the next two are unused
  dmat4 linear = dmat4(1.0);
  dquat turn = dquat(1.0, 0.0, 0.0, 0.0);  ///< the rotation in `linear`

  [[nodiscard]] dvec3 place(const dvec3& planted) const {
    return turns ? to + dvec3(linear * dvec4(planted - from, 0.0)) : to + (planted - from);
  }
};

/// None if blades must be planted anew: the ground was mirrored, stretched or shrunk by more than about 15 % in some
/// direction, or one of the matrices is not finite or has no inverse.
[[nodiscard]] std::optional<CarriedGround> carried_ground(const dmat4& planted, const dmat4& now);

/// Moves the patches of one surface to the ground's place of this frame. origins: of the patches when they were
/// planted. dt_s: since the frame before; 0: the same moment, in which nothing moves. Returns false if all
/// have been at rest since the frame before.
bool carry_patches(const CarriedGround& ground, std::span<const dvec3> origins, double dt_s,
                   std::span<GrassPatch> patches, std::span<GrassPatchMotion> motions);

}  // namespace gloam
