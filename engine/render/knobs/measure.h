// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// What a frame counted, by name ("lights.visible").
using FrameCounters = std::map<std::string, double>;

/// The error of a knob whose values all give the same picture, some by more work than others: a number of things, told
/// by what frames count. The ledger quotes it in place of the pictures' difference, which it still takes (it should be
/// nothing).
struct MeasureInfo {
  std::string knob;  ///< a knob of the same module
  std::string kind;  ///< of what is right, for the ledger: "brute force"
  std::string name;  ///< "exact per-pixel lists"
  std::string unit;  ///< of the error: "false positives a tile"
  /// "KNOB=VALUE" in force while frames are judged, not while they are timed: counting may cost.
  std::vector<std::string> judged_with;
  /// "KNOB=VALUE" of the frame whose picture is right.
  std::vector<std::string> picture;
  /// Of a frame, with what the same frame counts when the knob is at its default. ≥ 0, less is better; none: not
  /// counted this time.
  std::function<std::optional<double>(const FrameCounters& frame, const FrameCounters& standard)> error;
  /// Why the frame is wrong, whatever its error; empty: it is not.
  std::function<std::string(const FrameCounters& frame)> fault;
};

}  // namespace gloam
