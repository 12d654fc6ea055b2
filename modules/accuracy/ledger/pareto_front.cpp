// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

/// Whether `a` makes `b` pointless. Compares ratios, not times: two rows are timed minutes apart, but each ratio is to
/// a default that was timed alongside. A drift of the machine changes the times, not the ratios.
bool dominates(const LedgerRow& a, const LedgerRow& b) {
  const double error_a = *a.error();
  const double error_b = *b.error();
  const bool no_worse = error_a <= error_b && a.ratio <= b.ratio;
  return no_worse && (error_a < error_b || a.ratio < b.ratio);
}

/// Whether a row can be on a front, or keep others off it.
bool counts(const LedgerRow& row) { return row.error() && row.wrong.empty(); }

}  // namespace

std::optional<double> LedgerRow::error() const {
  if (counted) return counted->value;
  if (!flip && !rmse) return std::nullopt;
  return std::max(flip ? flip->mean : *rmse, reference_noise);
}

void mark_pareto_front(std::vector<LedgerRow>& rows) {
  for (LedgerRow& row : rows) {
    row.on_front = counts(row) && std::none_of(rows.begin(), rows.end(), [&](const LedgerRow& other) {
                     return other.knob == row.knob && counts(other) && dominates(other, row);
                   });
  }
}

}  // namespace gloam
