// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/run_rows.h"

#include <exception>
#include <utility>

namespace gloam {
namespace {

Result<BenchValue> run_row(const BenchRow& row, BenchContext& context) {
  try {
    return row.run(context);
  } catch (const std::exception& fault) {
    return Error{ErrorKind::failed, row.id + ": " + fault.what()};
  }
}

}  // namespace

RowsRun run_rows(std::span<const BenchRow* const> rows, BenchContext& context,
                 const std::function<void(const MeasuredRow&)>& finished) {
  RowsRun run;
  for (const BenchRow* row : rows) {
    auto value = run_row(*row, context);
    if (!value) {
      run.status = value.error();
      break;
    }
    run.rows.push_back({.row = row, .value = std::move(value).value()});
    finished(run.rows.back());
  }
  return run;
}

}  // namespace gloam
