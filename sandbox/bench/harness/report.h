// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "sandbox/bench/harness/registry.h"
#include "sandbox/session/results/stats.h"

namespace gloam {

struct MeasuredRow {
  const BenchRow* row = nullptr;
  BenchValue value;
};

/// One readable line: id, value, unit, bar, the paper's figure.
[[nodiscard]] std::string bench_line(const MeasuredRow& measured);
/// The `bench --json` text (schema version 1). Skipped rows are in a list of their own, which is absent without any.
[[nodiscard]] std::string bench_json(const RunDescription& run, std::span<const MeasuredRow> rows);

}  // namespace gloam
