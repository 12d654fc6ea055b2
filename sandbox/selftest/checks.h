// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "modules/accuracy/stability.h"
#include "sandbox/selftest/context.h"

namespace gloam {

/// Unit of differences of shown colours.
inline constexpr const char* kLevels = "of 255";

/// A check of the self-test. run() fills in what is measured.
struct SelfTestCheck {
  StabilityCheck check;
  bool quick = false;  ///< part of the quick self-test
  std::function<Status(SelfTestContext&, StabilityCheck&)> run;
};

/// Kernels alone against their twins on the CPU.
void add_kernel_checks(std::vector<SelfTestCheck>& checks);
/// What the GPU counts against brute force, and that no value of any picture is not finite. The last ones must run
/// after all others.
void add_count_checks(std::vector<SelfTestCheck>& checks);
void add_finite_check(std::vector<SelfTestCheck>& checks);
/// Pictures that must be equal: of the same frame, by other threads, by other ways to compute the same.
void add_invariance_checks(std::vector<SelfTestCheck>& checks);
/// Errors against place, scale, exposure, time, size and so on.
void add_place_curves(std::vector<SelfTestCheck>& checks);
void add_condition_curves(std::vector<SelfTestCheck>& checks);
/// Errors against the size and the range of lights, the slope of receivers, and the depth range of the camera.
void add_range_curves(std::vector<SelfTestCheck>& checks);

/// All checks, in the order in which they run.
[[nodiscard]] std::vector<SelfTestCheck> selftest_checks();

/// The check of a kernel or of a reference, from what it says of itself.
template <class Own>
[[nodiscard]] StabilityCheck kernel_stability(const Own& own) {
  return {.name = own.name,
          .kind = StabilityKind::kernel,
          .sentence = own.sentence,
          .unit = own.unit,
          .bound = own.bound,
          .advice = own.advice};
}

/// Notes an error at a point of a curve, and the worst one of the promised range.
void add_point(StabilityCheck& check, double at, double error, const std::string& words);
/// Notes an error of a case.
void add_case(StabilityCheck& check, double error, const std::string& words);

}  // namespace gloam
