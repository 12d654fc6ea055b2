// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/checks.h"

#include <cmath>

namespace gloam {

void add_case(StabilityCheck& check, double error, const std::string& words) {
  const bool worse = !std::isfinite(error) || error > check.worst;
  if (!std::isfinite(check.worst) || (!worse && !check.worst_case.empty())) return;
  check.worst = error;
  check.worst_case = words;
}

void add_point(StabilityCheck& check, double at, double error, const std::string& words) {
  check.curve.push_back({at, error});
  if (!check.promised || (at >= check.promised->low && at <= check.promised->high)) add_case(check, error, words);
}

std::vector<SelfTestCheck> selftest_checks() {
  std::vector<SelfTestCheck> checks;
  add_kernel_checks(checks);
  add_count_checks(checks);
  add_invariance_checks(checks);
  add_place_curves(checks);
  add_condition_curves(checks);
  add_range_curves(checks);
  add_finite_check(checks);
  return checks;
}

}  // namespace gloam
