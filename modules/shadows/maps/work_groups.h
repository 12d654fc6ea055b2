// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/math/types.h"

// Dispatches whose workgroups read their work from a buffer. One dispatch then serves parts of many faces, which saves
// the fixed cost of a dispatch per part.

namespace gloam {

/// The entries of the workgroup buffer that one dispatch processes.
struct GroupRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Splits the rectangle [begin, end) into parts of at most side × side and calls add(part_begin, part_end) for each,
/// row by row.
template <class Add>
void add_groups(uvec2 begin, uvec2 end, std::uint32_t side, const Add& add) {
  for (std::uint32_t y = begin.y; y < end.y; y += side)
    for (std::uint32_t x = begin.x; x < end.x; x += side) add(uvec2(x, y), glm::min(uvec2(x, y) + side, end));
}

/// Pushes `constants` and dispatches one workgroup per entry of `groups`, in several dispatches when there are many.
/// Constants::first_group is set to the first entry of each dispatch. target: a ComputePass or a gpu::CommandList.
template <class Target, class Constants>
void dispatch_groups(Target& target, Constants constants, const GroupRange& groups) {
  constexpr std::uint32_t kMost = 32768;  // workgroups along an axis; devices have at least 65535
  for (std::uint32_t done = 0; done < groups.count; done += kMost) {
    constants.first_group = groups.first + done;
    target.push(constants);
    target.dispatch(std::min(groups.count - done, kMost), 1, 1);
  }
}

}  // namespace gloam
