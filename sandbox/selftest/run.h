// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "modules/accuracy/stability.h"
#include "sandbox/options.h"
#include "sandbox/selftest/checks.h"

namespace gloam {

/// Whether `name` matches a pattern in which * stands for any characters; a pattern without * also matches all names
/// that begin with it and a dot.
[[nodiscard]] bool matches_check(std::string_view name, std::string_view pattern);

/// The checks of --quick and --only. Usage error for a pattern that matches none.
[[nodiscard]] Result<std::vector<SelfTestCheck>> chosen_checks(const Options& options);

/// Runs the checks, and calls `done` after each. Error without a device. A check that fails ends no other.
[[nodiscard]] Result<StabilityReport> run_selftest(const Options& options, LogSink& log,
                                                   const std::function<void(const StabilityCheck&)>& done);

}  // namespace gloam
