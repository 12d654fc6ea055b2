// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/render/governor/machine.h"

// A front with round numbers, and series of equal times.

namespace gloam::test {

/// Times 10, 20, 40 and 80 ms.
inline std::vector<GovernorPoint> four_points() { return geometric_front(4, 10.0, 2.0); }

/// Adds the same judged time `frames` times. Returns the last decision that changed the point or has a reason.
inline GovernorDecision add(Governor& governor, double ms, int frames, std::uint64_t view = 0) {
  GovernorDecision last;
  for (int i = 0; i < frames; ++i) {
    const GovernorDecision decision = governor.add({ms, true, view});
    if (decision.reason != GovernorReason::none) last = decision;
  }
  return last;
}

/// Frames whose decision has this reason.
inline std::size_t count(const Drive& drive, GovernorReason reason) {
  std::size_t found = 0;
  for (const DrawnFrame& frame : drive) found += frame.decision.reason == reason ? 1 : 0;
  return found;
}

/// A machine at whose point `heavy` and better ones frames take `factor` times as long as the front says.
inline Machine machine_with_heavy_points(const std::vector<GovernorPoint>& front, std::size_t heavy, double factor) {
  Machine machine = machine_of(front);
  for (std::size_t i = heavy; i < machine.ms.size(); ++i) machine.ms[i] *= factor;
  return machine;
}

}  // namespace gloam::test
