// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/text/formatted.h"
#include "sandbox/output/json_text.h"

namespace gloam {
namespace {

std::string short_number(double value) { return formatted("%.4g", value); }

/// scene: the scene of the run. The row names its scene only if it is a different one.
Json bench_row_json(const MeasuredRow& measured, const std::string& scene) {
  const BenchRow& row = *measured.row;
  const BenchValue& value = measured.value;
  Json json = {{"id", row.id}, {"value", value.value}, {"unit", row.unit}};
  json["p10"] = value.p10.value_or(value.value);
  json["p90"] = value.p90.value_or(value.value);
  const bool barred = has_bar(row, value);
  if (barred) json["bar"] = *row.bar;
  json["better"] = row.better == Better::lower ? "lower" : "higher";
  json["holds"] = !barred || keeps_bar(row, value.value);
  if (row.paper) json["paper"] = {{"value", row.paper->value}, {"unit", row.paper->unit}};
  json["hash"] = value.hash ? Json(*value.hash) : Json(nullptr);
  if (value.scene && *value.scene != scene) json["scene"] = *value.scene;
  return json;
}

}  // namespace

std::string bench_line(const MeasuredRow& measured) {
  const BenchRow& row = *measured.row;
  std::string line = row.id;
  line.resize(std::max<std::size_t>(line.size() + 1, 48), ' ');
  if (measured.value.skipped) return line + "skipped: " + *measured.value.skipped + "\n";
  line += short_number(measured.value.value) + " " + row.unit;
  if (measured.value.p10 && measured.value.p90)
    line += " (" + short_number(*measured.value.p10) + "…" + short_number(*measured.value.p90) + ")";
  if (has_bar(row, measured.value)) {
    const bool kept = keeps_bar(row, measured.value.value);
    line += std::string(row.better == Better::lower ? ", at most " : ", at least ") + short_number(*row.bar);
    line += kept ? ": holds" : ": MISSED";
  }
  if (row.paper) line += "; paper: " + short_number(row.paper->value) + " " + row.paper->unit;
  return line + "\n";
}

std::string bench_json(const RunDescription& run, std::span<const MeasuredRow> rows) {
  Json json = {{"version", 1}, {"device", device_json(run.device)}, {"size", {run.width, run.height}}};
  json["scene"] = run.scene;
  json["rows"] = Json::array();
  for (const MeasuredRow& measured : rows) {
    if (measured.value.skipped)
      json["skipped"].push_back({{"id", measured.row->id}, {"reason", *measured.value.skipped}});
    else
      json["rows"].push_back(bench_row_json(measured, run.scene));
  }
  return json_text(json);
}

}  // namespace gloam
