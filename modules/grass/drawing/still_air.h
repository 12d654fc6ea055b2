// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Shadow maps need not be drawn again while no blade that casts moves. Wind of 0 is not enough: blades bend under their
// weight and swing. The GPU counts the blades that moved; if it counts none, and nothing that blades depend on has
// changed since, they stay as they are, because a step computes the same from the same.
#pragma once

#include <cstdint>

#include "engine/render/frame_builder.h"
#include "modules/grass/lod/visible_patches.h"

namespace gloam {

/// What a frame's count of moving casters is read back with.
struct RestNote {
  std::uint64_t inputs = 0;  ///< rest_inputs()
  std::uint32_t steps = 0;   ///< of the simulation in the frame
};

/// Steps in a row in which no casting blade moved; a view resource.
struct GrassRest {
  std::uint64_t inputs = 0;  ///< rest_inputs() of these frames
  std::uint32_t steps = 0;
};

/// Hash of everything that moves the blades of a view or selects those that cast. 0 while the wind blows.
[[nodiscard]] std::uint64_t rest_inputs(FrameBuilder& frame, const VisiblePatches& visible);
[[nodiscard]] RestNote rest_note(FrameBuilder& frame, const VisiblePatches& visible);

/// rest: so far. moved: number of casting blades that moved in the frame, or that have not been simulated.
[[nodiscard]] GrassRest counted_rest(const GrassRest& rest, const RestNote& note, std::uint32_t moved);

/// Whether the casting blades of a frame with these inputs stand as in the frames before.
[[nodiscard]] bool casters_rest(const GrassRest* rest, std::uint64_t inputs);

}  // namespace gloam
