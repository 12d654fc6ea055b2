// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Counters of a frame, by name ("lights.visible").
using FrameCounters = std::map<std::string, double>;

/// Judges a knob whose values all draw the same picture, some with more work than others. The error is a count,
/// computed from the frame's counters. The ledger shows this count. It also measures the difference between the
/// pictures, which should be zero.
struct MeasureInfo {
  std::string knob;  ///< a knob of the same module
  std::string kind;  ///< kind of reference, for the ledger: "brute force"
  std::string name;  ///< "exact per-pixel lists"
  std::string unit;  ///< of the error: "false positives a tile"
  /// Knobs while frames are judged, but not while they are timed: counting may cost time.
  std::vector<KnobOverride> judged_with;
  /// Knobs of the frame with the right picture.
  std::vector<KnobOverride> picture;
  /// Error of a frame, from its counters and those of the same frame with the knob at its default (`standard`). ≥ 0,
  /// less is better; empty if the counters are missing.
  std::function<std::optional<double>(const FrameCounters& frame, const FrameCounters& standard)> error;
  /// Reason why the frame is wrong regardless of its error; empty if the frame is right.
  std::function<std::string(const FrameCounters& frame)> fault;
};

}  // namespace gloam
