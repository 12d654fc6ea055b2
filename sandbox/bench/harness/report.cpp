// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/report.h"

#include <cstdio>

namespace gloam {
namespace {

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

}  // namespace

std::string bench_line(const MeasuredRow& measured) {
  const BenchRow& row = *measured.row;
  std::string line = row.id;
  line.resize(std::max<std::size_t>(line.size() + 1, 48), ' ');
  line += short_number(measured.value.value) + " " + row.unit;
  if (measured.value.p10 && measured.value.p90)
    line += " (" + short_number(*measured.value.p10) + "…" + short_number(*measured.value.p90) + ")";
  if (row.bar) {
    const bool kept = holds(row, measured.value.value);
    line += std::string(row.better == Better::lower ? ", at most " : ", at least ") + short_number(*row.bar);
    line += kept ? ": holds" : ": MISSED";
  }
  return line + "\n";
}

std::string bench_json(const RunDescription& run, std::span<const MeasuredRow> rows) {
  JsonWriter json;
  json.begin_object().key("version").integer(1);
  write_device(json, run.device);
  json.key("size").begin_array().integer(run.width).integer(run.height).end_array();
  json.key("scene").text(run.scene).key("rows").begin_array();
  for (const MeasuredRow& measured : rows) {
    const BenchRow& row = *measured.row;
    const BenchValue& value = measured.value;
    json.begin_object().key("id").text(row.id).key("value").number(value.value).key("unit").text(row.unit);
    json.key("p10").number(value.p10.value_or(value.value)).key("p90").number(value.p90.value_or(value.value));
    if (row.bar) json.key("bar").number(*row.bar);
    json.key("better")
        .text(row.better == Better::lower ? "lower" : "higher")
        .key("holds")
        .boolean(holds(row, value.value));
    json.key("hash");
    if (value.hash) {
      json.text(*value.hash);
    } else {
      json.null();
    }
    if (value.scene && *value.scene != run.scene) json.key("scene").text(*value.scene);
    json.end_object();
  }
  json.end_array().end_object();
  return json.finish();
}

}  // namespace gloam
