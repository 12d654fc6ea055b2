// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

// What a self-test has found on a device: whether the mathematics holds, how far, and where it ends.

namespace gloam {

enum class StabilityKind : std::uint8_t {
  kernel,      ///< what the GPU computes against brute force or double precision
  invariance,  ///< pictures that must be equal
  curve,       ///< an error as a condition gets harder
};

struct StabilityPoint {
  double at = 0.0;  ///< on the check's axis
  double error = 0.0;
  bool operator==(const StabilityPoint&) const = default;
};

struct StabilityRange {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const StabilityRange&) const = default;
};

struct StabilityCheck {
  std::string name;  ///< "moved.lamp"; unique
  StabilityKind kind = StabilityKind::invariance;
  std::string sentence;  ///< what is compared with what
  std::string unit;      ///< of errors: "of 255"
  double bound = 0.0;    ///< the largest error that holds
  std::string advice;    ///< what a user can do if it does not hold
  std::string axis;      ///< of a curve, with its unit: "distance from the origin, m"
  /// Of a curve: where its errors must keep the bound. Points outside show where it ends.
  std::optional<StabilityRange> promised = {};

  double worst = 0.0;      ///< the largest error; of a curve, in the promised range
  std::string worst_case;  ///< where: "1000 km", "builtin:lanterns"
  std::vector<StabilityPoint> curve = {};
  std::string skipped = {};  ///< why nothing was measured; empty: something was
  std::string fault = {};    ///< an error that ended the check
  double seconds = 0.0;
};

/// Whether the worst error is finite and keeps the bound. A skipped check holds, one with a fault does not.
[[nodiscard]] bool holds(const StabilityCheck& check);

/// The widest range of a curve whose points all keep the bound, and which overlaps the promised one; none if there is
/// no such point.
[[nodiscard]] std::optional<StabilityRange> range_within_bound(const StabilityCheck& check);

struct StabilityReport {
  std::string gloam;   ///< version
  std::string device;  ///< name
  std::string driver;
  std::string device_type;  ///< "cpu", "discrete"
  std::uint32_t subgroup_size = 0;
  std::string host;
  bool quick = false;
  double seconds = 0.0;
  std::vector<StabilityCheck> checks;
};

/// Number of checks that do not hold.
[[nodiscard]] std::size_t failed_checks(const StabilityReport& report);

/// A line of the table on the terminal: check, worst case, bound, margin.
[[nodiscard]] std::string stability_line(const StabilityCheck& check);
/// A table of the curves' promised ranges in Markdown, for docs/limits.md.
[[nodiscard]] std::string limits_table(std::span<const StabilityCheck> checks);
/// selftest.json
[[nodiscard]] std::string stability_json(const StabilityReport& report);
/// Reads it back. Malformed text gives an error of ErrorKind::input that names the fault.
[[nodiscard]] Result<StabilityReport> parse_stability_json(std::string_view text);
/// selftest.html: self-contained, with a plot of each curve.
[[nodiscard]] std::string stability_html(const StabilityReport& report);

}  // namespace gloam
