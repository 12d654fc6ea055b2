// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/gpu/command_list.h"
#include "engine/math/types.h"

// Dispatches whose workgroups look up in a buffer what they are to do: one for the parts of many faces, as every
// dispatch has its price.

namespace gloam {

/// Workgroups of one dispatch, in a buffer of them.
struct GroupRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Calls add(begin, end) with the corners of parts, at most `side` wide and high, that fill what lies between two
/// corners.
template <class Add>
void add_groups(uvec2 begin, uvec2 end, std::uint32_t side, const Add& add) {
  for (std::uint32_t y = begin.y; y < end.y; y += side)
    for (std::uint32_t x = begin.x; x < end.x; x += side) add(uvec2(x, y), glm::min(uvec2(x, y) + side, end));
}

/// Constants::first_group tells a workgroup where its range begins.
template <class Constants>
void dispatch_groups(gpu::CommandList& commands, Constants constants, const GroupRange& groups) {
  constexpr std::uint32_t kMost = 32768;  // workgroups along an axis; devices have at least 65535
  for (std::uint32_t done = 0; done < groups.count; done += kMost) {
    constants.first_group = groups.first + done;
    commands.push(constants);
    commands.dispatch(std::min(groups.count - done, kMost), 1, 1);
  }
}

}  // namespace gloam
