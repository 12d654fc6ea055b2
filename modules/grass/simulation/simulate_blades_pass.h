// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "engine/render/declare/compute_pass.h"
#include "modules/grass/frame.h"

namespace gloam {

/// The threads that a device runs with SimulationThreads::device.
[[nodiscard]] SimulationThreads simulation_threads(SimulationThreads chosen, bool threads_in_turn);
/// Masters that one workgroup simulates. threads: not `device`.
[[nodiscard]] std::uint32_t simulation_group_masters(SimulationThreads threads);
/// colliders: whether any patch has some. threads: not `device`.
[[nodiscard]] ComputeProgram grass_simulation_program(SimulationThreads threads, bool colliders);

/// Masters that an earlier frame of the view had to simulate. A view resource, with grass.dispatch=readback only.
struct GrassFeedback {
  std::uint32_t masters = 0;
};

/// Runs the steps of the listed masters. Returns the store after the frame. groups: size of the dispatch; none: the
/// GPU's own (MasterList::dispatch).
[[nodiscard]] GrassStore add_simulation_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                                             const MasterList& list, std::optional<std::uint32_t> groups);

}  // namespace gloam
