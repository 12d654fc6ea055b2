// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

/// Whether `a` makes `b` pointless.
bool dominates(const LedgerRow& a, const LedgerRow& b) {
  const double error_a = *a.error();
  const double error_b = *b.error();
  const bool no_worse = error_a <= error_b && a.ms.median_ms <= b.ms.median_ms;
  return no_worse && (error_a < error_b || a.ms.median_ms < b.ms.median_ms);
}

}  // namespace

std::optional<double> LedgerRow::error() const {
  if (!flip && !rmse) return std::nullopt;
  return std::max(flip ? flip->mean : *rmse, reference_noise);
}

void mark_pareto_front(std::vector<LedgerRow>& rows) {
  for (LedgerRow& row : rows) {
    row.on_front = row.error() && std::none_of(rows.begin(), rows.end(), [&](const LedgerRow& other) {
                     return other.knob == row.knob && other.error() && dominates(other, row);
                   });
  }
}

}  // namespace gloam
