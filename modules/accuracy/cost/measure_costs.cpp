// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/core/assert.h"
#include "modules/accuracy/cost/knob_measurement.h"
#include "modules/accuracy/ledger/measurement_store.h"
#include "modules/accuracy/module.h"

namespace gloam {

Result<Ledger> measure_costs(const CostRequest& request, CostSubject& subject, CostProgress& progress) {
  GLOAM_ASSERT(request.header.frames > 0 && request.sequence > 0, "a ledger is of at least one frame");
  const MeasurementStore store(request.folder + "/measurements");
  std::size_t total = 0;
  for (const std::string& name : request.knobs) {
    GLOAM_ASSERT(subject.knobs().find(name) != nullptr, "a measured knob exists");
    total += ledger_values(*subject.knobs().find(name)).size();
  }
  Ledger ledger = {.header = request.header, .rows = {}, .skipped = request.skipped};
  for (const std::string& name : request.knobs) {
    const Knob& knob = *subject.knobs().find(name);
    KnobMeasurement measurement(request, subject, knob);
    for (const std::string& value : ledger_values(knob)) {
      const std::string identity = measurement.identity(value);
      std::optional<LedgerRow> row = store.load(identity);
      const bool resumed = row.has_value();
      if (!resumed) {
        progress.measuring(name, value, ledger.rows.size(), total);
        auto measured = measurement.measure(value);
        if (!measured) return Error{measured.error().kind, name + "=" + value + ": " + measured.error().message};
        row = std::move(measured).value();
        GLOAM_TRY(store.save(identity, *row));
      }
      progress.finished(*row, resumed);
      ledger.rows.push_back(std::move(*row));
    }
  }
  mark_pareto_front(ledger.rows);
  return ledger;
}

}  // namespace gloam
