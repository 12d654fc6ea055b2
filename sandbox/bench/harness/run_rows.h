// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "sandbox/bench/harness/report.h"

namespace gloam {

/// The rows that were measured, and whether all were.
struct RowsRun {
  std::vector<MeasuredRow> rows;
  Status status;  ///< the error of the row that failed; the rows after it were not run
};

/// Measures rows in order until one fails or throws; calls `finished` after each. rows: must outlive the result.
[[nodiscard]] RowsRun run_rows(std::span<const BenchRow* const> rows, BenchContext& context,
                               const std::function<void(const MeasuredRow&)>& finished);

}  // namespace gloam
