// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/particles/frame.h"

namespace gloam {

/// The programs of the passes.
[[nodiscard]] std::vector<ComputeProgram> particle_sort_programs(bool threads_in_turn);

/// Sorts particles by their keys, one for each of `places`, and counts those that are drawn. two_digits: keys have 16
/// bits and not 8.
[[nodiscard]] SortedParticles add_particle_sort_passes(FrameBuilder& frame, BufferRef keys, std::uint32_t places,
                                                       bool two_digits);

}  // namespace gloam
