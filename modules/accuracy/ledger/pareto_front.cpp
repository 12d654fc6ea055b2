// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

using KnobValues = std::vector<LedgerRow*>;

/// Whether a row can be on a front, or keep others off it.
bool counts(const LedgerRow& row) { return row.error() && row.wrong.empty(); }

bool same_picture(const LedgerRow& a, const LedgerRow& b) { return !a.picture.empty() && a.picture == b.picture; }

/// Intervals, not medians: a difference inside them is chance.
bool significantly_cheaper(const LedgerRow& a, const LedgerRow& b) {
  if (!same_picture(a, b)) return a.ratio_high < b.ratio_low;
  constexpr double kResolution_ms = 0.03;  // of processor time: frames of the same work differ by as much
  constexpr double kBetweenRuns = 0.03;    // other runs have medians outside of one run's interval by as much
  return a.sure_high < (1.0 - kBetweenRuns) * b.sure_low && b.ms.median_ms - a.ms.median_ms > kResolution_ms;
}

bool significantly_righter(const LedgerRow& a, const LedgerRow& b) {
  const double noise = a.counted || b.counted ? 0.0 : std::max(a.reference_noise, b.reference_noise);
  return *a.error() + noise < *b.error();
}

/// Whether `a` makes `b` pointless.
bool dominates(const LedgerRow& a, const LedgerRow& b) {
  if (significantly_cheaper(a, b)) return *a.error() <= *b.error();
  return !significantly_cheaper(b, a) && significantly_righter(a, b);
}

/// Keeps one of the values on the front whose pictures are equal.
void keep_one_of_equals(const KnobValues& values) {
  for (LedgerRow* kept : values) {
    if (!kept->on_front) continue;
    KnobValues equals;
    for (LedgerRow* row : values)
      if (row->on_front && same_picture(*row, *kept)) equals.push_back(row);
    if (equals.size() < 2) continue;
    const auto standard =
        std::find_if(equals.begin(), equals.end(), [](const LedgerRow* row) { return row->is_default; });
    const auto cheapest = std::min_element(equals.begin(), equals.end(), [](const LedgerRow* a, const LedgerRow* b) {
      return a->sure_high < b->sure_high;
    });
    const LedgerRow* representative = standard != equals.end() ? *standard : *cheapest;
    for (LedgerRow* row : equals) row->on_front = row == representative;
  }
}

void mark(const KnobValues& values) {
  const auto standard =
      std::find_if(values.begin(), values.end(), [](const LedgerRow* row) { return row->is_default; });
  for (LedgerRow* row : values) {
    row->no_effect = standard != values.end() && row->wrong.empty() && same_picture(*row, **standard) &&
                     !significantly_cheaper(*row, **standard) && !significantly_cheaper(**standard, *row);
  }
  const bool nothing_changes = values.size() > 1 && std::all_of(values.begin(), values.end(),
                                                                [](const LedgerRow* row) { return row->no_effect; });
  for (LedgerRow* row : values) {
    row->on_front = counts(*row) && !nothing_changes &&
                    std::none_of(values.begin(), values.end(),
                                 [&](const LedgerRow* other) { return counts(*other) && dominates(*other, *row); });
  }
  keep_one_of_equals(values);
}

}  // namespace

std::optional<double> LedgerRow::error() const {
  if (counted) return counted->value;
  if (!flip && !rmse) return std::nullopt;
  return std::max(flip ? flip->mean : *rmse, reference_noise);
}

void mark_pareto_front(std::vector<LedgerRow>& rows) {
  std::vector<const LedgerRow*> done;
  for (const LedgerRow& first : rows) {
    if (std::any_of(done.begin(), done.end(), [&](const LedgerRow* row) { return row->knob == first.knob; })) continue;
    done.push_back(&first);
    KnobValues values;
    for (LedgerRow& row : rows)
      if (row.knob == first.knob) values.push_back(&row);
    mark(values);
  }
}

}  // namespace gloam
