// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace gloam {

/// The faces of a light, for pace_sizes().
struct PacedLight {
  std::uint32_t faces = 0;
  std::uint32_t held = 0;    ///< texels of the side of the squares that the faces have; 0: they have none
  std::uint32_t wanted = 0;  ///< texels of the side that they ask for; 0: the light has no faces
  float importance = 0.0f;
  std::uint32_t size = 0;  ///< result: texels of the side in this frame; 0: no faces yet
};

/// Frames over which a change of all sizes is spread, if no light has more than its share of the texels.
inline constexpr std::uint32_t kPacedFrames = 12;

/// Chooses sizes so that a change of many sizes does not draw all maps in one frame: each frame lets lights change
/// until a share of 1 / kPacedFrames of all wanted texels is drawn, and at least one light. The others keep the sizes
/// that they hold. Lights that shrink come first, then the most important. Lights without squares get theirs at once,
/// or, if fill, when their turn comes. room: texels of the atlas. If the wanted sizes do not all fit, nothing waits.
/// Returns the number of faces that wait.
std::uint32_t pace_sizes(std::span<PacedLight> lights, std::uint64_t room, bool fill);

}  // namespace gloam
