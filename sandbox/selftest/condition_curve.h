// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "sandbox/selftest/checks.h"

namespace gloam {

/// The error of a scene at a value of an axis. usual: the picture under usual conditions.
using ErrorAt = std::function<Result<double>(SelfTestContext& context, const TestPicture& usual, double value)>;

/// A curve over a condition of the scene or the view.
struct ConditionCurve {
  StabilityCheck check;
  const char* axis_unit;
  bool quick = false;
  std::vector<double> values;
  std::function<Result<TestPicture>(SelfTestContext&)> usual;  ///< empty: error_at needs none
  ErrorAt error_at;
};

[[nodiscard]] StabilityCheck curve_check(const char* name, const char* sentence, const char* unit, double bound,
                                         const char* advice, const char* axis, StabilityRange promised);
/// Mean difference of the shown colours.
[[nodiscard]] Result<double> difference(const Result<TestPicture>& drawn, const TestPicture& usual);
void add_curve(ConditionCurve curve, std::vector<SelfTestCheck>& checks);

}  // namespace gloam
