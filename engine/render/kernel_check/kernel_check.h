// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

// Kernels against their twins on the CPU, by readback: a program can run these checks on its user's device. The tests
// of the kernels compare with the same twins.

namespace gloam {

class KernelLab;

/// The largest error of a check, and where it is.
struct KernelError {
  double worst = 0.0;
  std::string where;  ///< "4097 keys"

  /// An error that is not finite is worse than all others.
  void add(double error, std::string_view at) {
    const bool worse = std::isfinite(worst) && (!std::isfinite(error) || error > worst);
    if (!worse && !where.empty()) return;
    if (worse) worst = error;
    where = at;
  }
};

/// A check of one kernel. Its inputs are fixed, so that a device gives the same error each time.
struct KernelCheck {
  std::string name;      ///< "kernel.radix_sort"; unique
  std::string sentence;  ///< what is compared with what
  std::string unit;      ///< of the error
  double bound = 0.0;    ///< the largest error that holds
  std::string advice;    ///< what a user can do if it does not hold, in one sentence
  bool quick = false;    ///< takes less than a second on a slow device
  std::function<Result<KernelError>(KernelLab&)> run;
};

/// The checks of the engine's own kernels. Those of a module: reference/kernel_checks.h in its folder.
[[nodiscard]] std::vector<KernelCheck> engine_kernel_checks();

}  // namespace gloam
