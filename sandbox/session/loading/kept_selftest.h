// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "modules/accuracy/stability.h"
#include "sandbox/options.h"

namespace gloam {

/// Keeps a self-test in the cache, for its device; does nothing without a cache.
[[nodiscard]] Status keep_selftest(const StabilityReport& report, const Options& options);

/// The self-test that was kept for a device and driver; none if there is none that can be read.
[[nodiscard]] std::optional<StabilityReport> find_selftest(const Options& options, const std::string& device,
                                                           const std::string& driver, LogSink& log);

}  // namespace gloam
