// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

/// Order of rows by their error; a row without one is before all others.
bool less_right(const LedgerRow& a, const LedgerRow& b) { return a.error().value_or(-1.0) > b.error().value_or(-1.0); }

/// rows: one value in each camera, at least one.
LedgerRow worst_row(const std::vector<const LedgerRow*>& rows) {
  LedgerRow worst = *rows.front();
  for (const LedgerRow* row : rows)
    if (less_right(*row, worst)) worst = *row;
  worst.no_effect = std::ranges::all_of(rows, [](const LedgerRow* row) { return row->no_effect; });
  for (const LedgerRow* row : rows) {
    if (worst.wrong.empty()) worst.wrong = row->wrong;
    worst.gpu_bytes = std::max(worst.gpu_bytes, row->gpu_bytes);
    if (row->effect_model && (!worst.effect_model || row->effect_model->flip.mean > worst.effect_model->flip.mean))
      worst.effect_model = row->effect_model;
    if (row->ratio > worst.ratio) {
      worst.ratio = row->ratio;
      std::tie(worst.ratio_low, worst.ratio_high) = std::tie(row->ratio_low, row->ratio_high);
      std::tie(worst.sure_low, worst.sure_high) = std::tie(row->sure_low, row->sure_high);
      worst.pairs = row->pairs;
    }
    if (row->ms.median_ms <= worst.ms.median_ms) continue;
    worst.ms = row->ms;
    std::tie(worst.wall_ms, worst.cpu_ms, worst.gpu_ms) = std::tie(row->wall_ms, row->cpu_ms, row->gpu_ms);
    std::tie(worst.module_cpu_ms, worst.module_gpu_ms) = std::tie(row->module_cpu_ms, row->module_gpu_ms);
  }
  return worst;
}

}  // namespace

Ledger worst_of_cameras(std::vector<Ledger> ledgers) {
  GLOAM_ASSERT(!ledgers.empty(), "the worst is of at least one camera");
  if (ledgers.size() == 1) return std::move(ledgers.front());
  Ledger worst = {.header = ledgers.front().header, .rows = {}, .skipped = ledgers.front().skipped};
  std::vector<std::vector<const LedgerRow*>> values;
  for (const Ledger& ledger : ledgers) {
    if (&ledger != &ledgers.front() && !ledger.header.camera.empty()) worst.header.camera += "," + ledger.header.camera;
    for (const LedgerRow& row : ledger.rows) {
      const auto same = std::ranges::find_if(
          values, [&](const auto& rows) { return rows.front()->knob == row.knob && rows.front()->value == row.value; });
      if (same == values.end())
        values.push_back({&row});
      else
        same->push_back(&row);
    }
  }
  for (const auto& rows : values) worst.rows.push_back(worst_row(rows));
  std::vector<bool> no_effect;
  for (const LedgerRow& row : worst.rows) no_effect.push_back(row.no_effect);
  mark_pareto_front(worst.rows);
  // Two values' worst pictures may be of different cameras, so their equality says nothing of the knob.
  for (std::size_t i = 0; i < worst.rows.size(); ++i) {
    LedgerRow& row = worst.rows[i];
    row.no_effect = no_effect[i];
    row.on_front = row.on_front && (row.is_default || !row.no_effect);
  }
  for (Ledger& ledger : ledgers)
    worst.cameras.push_back({ledger.header.camera, ledger.header.time_s, std::move(ledger.rows)});
  return worst;
}

LedgerRow worst_point(std::span<const LedgerRow> rows, std::span<const double> default_ms, std::size_t shown) {
  GLOAM_ASSERT(!rows.empty() && rows.size() == default_ms.size() && shown < rows.size(), "a row for each camera");
  if (rows.size() == 1) return rows.front();
  std::size_t slowest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (default_ms[i] * rows[i].ratio > default_ms[slowest] * rows[slowest].ratio) slowest = i;
  LedgerRow worst = rows[slowest];
  const LedgerRow& least_right = *std::ranges::min_element(rows, less_right);
  std::tie(worst.flip, worst.rmse, worst.rmse_p99) = std::tie(least_right.flip, least_right.rmse, least_right.rmse_p99);
  std::tie(worst.psnr_db, worst.whole) = std::tie(least_right.psnr_db, least_right.whole);
  for (const LedgerRow& row : rows) worst.gpu_bytes = std::max(worst.gpu_bytes, row.gpu_bytes);
  worst.picture = rows[shown].picture;
  worst.reference_picture = rows[shown].reference_picture;
  worst.worst = rows[shown].worst;
  const double scale = default_ms[slowest] / *std::ranges::max_element(default_ms);
  for (double* ratio : {&worst.ratio, &worst.ratio_low, &worst.ratio_high, &worst.sure_low, &worst.sure_high})
    *ratio *= scale;
  return worst;
}

}  // namespace gloam
