// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/outputs.h"

namespace gloam {
namespace {

constexpr std::size_t kColumns = 15;
using Line = std::array<std::string, kColumns>;
const Line kTitles = {"",         "knob",  "value", "counted", "FLIP mean", "FLIP p99",       "at edges", "RMSE",
                      "temporal", "whole", "ms",    "p10-p90", "ratio",     "module CPU+GPU", "MiB"};
constexpr std::size_t kTextColumns = 3;  // left-aligned

/// A column that is shown only if a row has its error.
struct OptionalColumn {
  std::size_t column = 0;
  bool (*has)(const LedgerRow& row) = nullptr;
};
constexpr std::array<OptionalColumn, 4> kOptionalColumns = {
    {{3, [](const LedgerRow& row) { return row.counted.has_value(); }},
     {6, [](const LedgerRow& row) { return row.edges.has_value(); }},
     {8, [](const LedgerRow& row) { return row.temporal.has_value(); }},
     {9, [](const LedgerRow& row) { return row.whole.has_value(); }}}};

std::string error_text(const LedgerRow& row, const double* value) {
  if (value == nullptr) return "-";
  return row.below_noise ? "< noise" : formatted("%.6f", *value);
}

std::string counted_text(const LedgerRow& row) {
  if (!row.counted) return {};
  const std::string value = formatted("%.3f", row.counted->value);
  return row.counted->p99 ? value + formatted(", p99 %.3f", *row.counted->p99) : value;
}

Line line_of(const LedgerRow& row) {
  return {!row.wrong.empty()                 ? "!"
          : row.on_front                     ? "*"
          : row.no_effect && !row.is_default ? "="
                                             : "",
          row.knob,
          row.value + (row.is_default ? " (default)" : ""),
          counted_text(row),
          error_text(row, row.flip ? &row.flip->mean : nullptr),
          error_text(row, row.flip ? &row.flip->p99 : nullptr),
          row.edges ? error_text(row, &row.edges->flip.mean) : "",
          error_text(row, row.rmse ? &*row.rmse : nullptr),
          row.temporal ? formatted("%.6f", row.temporal->mean) : "",
          row.whole ? formatted("%.6f", row.whole->flip.mean) : "",
          formatted("%.3f", row.ms.median_ms),
          formatted("%.3f-%.3f", row.ms.p10_ms, row.ms.p90_ms),
          row.is_default ? std::string("1") : formatted("%.2f (%.2f-%.2f)", row.ratio, row.ratio_low, row.ratio_high),
          formatted("%.3f+%.3f", row.module_cpu_ms, row.module_gpu_ms),
          formatted("%.1f", static_cast<double>(row.gpu_bytes) / (1024.0 * 1024.0))};
}

std::string aligned(const Line& line, const std::array<std::size_t, kColumns>& widths) {
  std::string text;
  for (std::size_t i = 0; i < kColumns; ++i) {
    const bool optional = std::ranges::find(kOptionalColumns, i, &OptionalColumn::column) != kOptionalColumns.end();
    if (optional && widths[i] == 0) continue;
    const std::string gap(widths[i] - line[i].size(), ' ');
    text += (i > 0 ? "  " : "") + (i < kTextColumns ? line[i] + gap : gap + line[i]);
  }
  return text.erase(text.find_last_not_of(' ') + 1) + "\n";
}

std::string head(const LedgerHeader& header) {
  std::string text = header.scene + " (" + header.scene_hash + "), " + formatted("%ux%u", header.width, header.height);
  if (!header.camera.empty()) text += ", camera " + header.camera;
  text += formatted(", time %g s\n", header.time_s);
  text += header.device + ", " + header.driver + "; gloam " + header.version + " (" + header.build + ")\n";
  text += "times: " + header.clock + "\n";
  if (header.quick)
    text += formatted("quick: %ux%u, at most %u frames a value, %u reference samples: errors and times are noisier\n",
                      header.width, header.height, header.frames, header.samples);
  if (header.seconds > 0.0)
    text += formatted("values get fewer frames, at least 6, so that measuring takes about %g minutes\n",
                      header.seconds / 60.0);
  return text;
}

/// The reference of each knob's rows, and the reasons of wrong rows.
std::string judgements(const std::vector<LedgerRow>& rows) {
  std::string text;
  for (const LedgerRow& row : rows) {
    std::string line = row.knob + ": " +
                       (row.reference_kind.empty() ? "no reference: " + no_reference_text(row)
                                                   : row.reference_kind + ", " + row.reference_name);
    if (row.counted) line += "; counted: " + row.counted->unit;
    if (text.find(line + "\n") == std::string::npos) text += line + "\n";
  }
  for (const LedgerRow& row : rows) {
    if (!row.wrong.empty()) text += "! " + row.knob + "=" + row.value + " is wrong: " + row.wrong + "\n";
  }
  return text;
}

/// A line for each effect whose model is judged: how far the default's frame is from what the model approximates.
std::string model_errors(const std::vector<LedgerRow>& rows) {
  std::string text;
  for (const LedgerRow& row : rows) {
    if (!row.is_default || !row.effect_model) continue;
    text += row.knob + "=" + row.value + ": the effect's model differs by mean FLIP " +
            formatted("%.6f (noise %.6f), RMSE %.4g cd/m² from ", row.effect_model->flip.mean, row.effect_model->noise,
                      row.effect_model->rmse) +
            row.effect_model->name + "\n";
  }
  return text;
}

/// Whether all values of a knob are without effect, so that its rows are folded into one line.
bool changes_nothing(const Ledger& ledger, std::string_view knob) {
  std::size_t values = 0;
  for (const LedgerRow& row : ledger.rows) {
    if (row.knob != knob) continue;
    if (!row.no_effect) return false;
    ++values;
  }
  return values > 1;
}

/// Of the default's row; a ledger may lack it.
std::string reason_of(const Ledger& ledger, std::string_view knob) {
  for (const LedgerRow& row : ledger.rows)
    if (row.knob == knob && row.is_default) return row.no_effect_reason;
  return {};
}

/// Whether values of the knob were timed, beside the default.
bool was_timed(const Ledger& ledger, std::string_view knob) {
  for (const LedgerRow& row : ledger.rows)
    if (row.knob == knob && !row.is_default && row.pairs > 0) return true;
  return false;
}

/// A line for each knob that changes nothing.
std::string without_effect(const Ledger& ledger) {
  std::string text;
  std::string_view last;
  for (const LedgerRow& row : ledger.rows) {
    if (row.knob == last || !changes_nothing(ledger, row.knob)) continue;
    last = row.knob;
    const std::string reason = reason_of(ledger, row.knob);
    text += row.knob + ": no effect here: " + (reason.empty() ? "" : reason + "; ") +
            "the pictures of all values are equal, and " +
            (was_timed(ledger, row.knob) ? "no difference in time is significant\n" : "they were not timed\n");
  }
  return text;
}

}  // namespace

std::string no_reference_text(const LedgerRow& row) {
  return row.no_reference.empty() ? "no value is more right than another" : row.no_reference;
}

std::string points_table(const Ledger& ledger) {
  if (ledger.points.empty()) return {};
  std::string text =
      formatted("the front of %zu measured combinations, the fastest first; error: mean FLIP against the ",
                ledger.points.size()) +
      "frame with every knob at its most exact value\n       ms  ratio                 error  setting\n";
  for (const LedgerPoint& point : ledger.points) {
    const LedgerRow& row = point.measured;
    if (!row.on_front && !row.is_default && !point.is_exact) continue;
    const std::string ratio =
        row.is_default ? std::string("1") : formatted("%.2f (%.2f-%.2f)", row.ratio, row.ratio_low, row.ratio_high);
    text += formatted("%s %9.3f  %-18s  %8.6f  ", row.on_front ? "*" : " ", row.ms.median_ms, ratio.c_str(),
                      row.flip->mean);
    text += row.is_default   ? "the user's own settings"
            : point.is_exact ? "the exact setting"
                             : settings_text(point.settings);
    text += "\n";
  }
  if (ledger.model)
    text += formatted("measured / predicted over %u combinations: time %.2f (worst %.2f), error %.2f (worst %.2f)\n",
                      ledger.model->points, ledger.model->time.median, ledger.model->time.worst,
                      ledger.model->error.median, ledger.model->error.worst);
  return text;
}

std::string ledger_table(const Ledger& ledger) {
  std::vector<Line> lines = {kTitles};
  for (const LedgerRow& row : ledger.rows)
    if (!changes_nothing(ledger, row.knob)) lines.push_back(line_of(row));
  for (const OptionalColumn& optional : kOptionalColumns)
    if (std::ranges::none_of(ledger.rows, optional.has)) lines.front()[optional.column].clear();
  std::array<std::size_t, kColumns> widths{};
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text = head(ledger.header);
  for (const Line& line : lines) text += aligned(line, widths);
  text += judgements(ledger.rows) + model_errors(ledger.rows);
  text += without_effect(ledger);
  if (!ledger.cameras.empty())
    text += formatted(
        "errors, ratios and times are the worst of %zu cameras, each by itself; report.html has a table "
        "of each camera\n",
        ledger.cameras.size());
  for (const SkippedKnob& skipped : ledger.skipped) text += skipped.knob + ": not measured: " + skipped.reason + "\n";
  return text +
         "* no other value of the knob is as cheap and as right; = the default's picture and time; ratio to the "
         "default's time, with its 95 % interval; at edges: mean FLIP of the pixels within two of an edge of the "
         "reference; RMSE in cd/m²; whole: mean FLIP against the frame with every knob at "
         "its most exact value; module CPU+GPU: wall time of the knob's module "
         "alone\n";
}

}  // namespace gloam
