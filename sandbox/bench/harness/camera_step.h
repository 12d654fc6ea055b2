// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"

namespace gloam {

inline constexpr double kTurnDegrees = 0.25;        ///< of a camera that moves, each frame
inline constexpr double kStepShare = 1.0 / 2000.0;  ///< the camera's step each frame, in distances to what it sees

/// The pose of a camera after `frames` frames of smooth motion: it turns about the vertical through its position, and
/// steps to its right. Before the pose if frames < 0. seen_m: distance to what it sees, > 0.
[[nodiscard]] dmat4 moved_camera(const dmat4& world_from_camera, double seen_m, double frames);

}  // namespace gloam
