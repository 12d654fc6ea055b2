// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

constexpr double kVisibleGain_db = 1.0;  // smaller differences at edges are not told

bool shows_flip(const KnobResults& knob) {
  return std::ranges::any_of(knob.rows, [](const LedgerRow* row) { return row->flip && !row->counted; });
}

/// Marks of a row in words.
std::string row_notes(const LedgerRow& row) {
  std::string notes;
  const auto add = [&](const std::string& note) { notes += (notes.empty() ? "" : ", ") + note; };
  if (row.is_default) add("default");
  if (row.on_front) add("front");
  if (row.reference_kind == "brute force" && row.reference_name == setting_of(row)) add("exact");
  if (row.no_effect && !row.is_default) add("no effect");
  if (!row.wrong.empty()) add("wrong: " + row.wrong);
  return notes;
}

std::string number_td(const std::optional<double>& value) {
  return "<td class=\"number\">" + (value ? number_text(*value) : std::string("–")) + "</td>";
}

std::string value_row(const KnobResults& knob, const LedgerRow& row) {
  std::string html = "<tr><th scope=\"row\">" + look_link(row, knob.standard, escaped(row.value)) +
                     "</th><td class=\"number\">" + ratio_text(row) + "</td>";
  std::string notes = row_notes(row);
  if (shows_flip(knob)) {
    html += number_td(flip_error(row)) + number_td(row.flip ? std::optional(row.flip->p99) : std::nullopt);
    html += number_td(row.edges ? std::optional(row.edges->flip.mean) : std::nullopt);
    if (row.flip)
      notes = (*flip_error(row) == 0.0 ? std::string("equal to the reference")
                                       : std::string(visibility_words({*flip_error(row), row.flip->p99}))) +
              (row.below_noise ? ", below the reference’s noise" : "") + (notes.empty() ? "" : "; ") + notes;
  } else {
    html += "<td>" + escaped(error_text_of(row)) + "</td>";
  }
  return html + "<td>" + escaped(notes) + "</td></tr>\n";
}

/// The region scrolls on narrow screens.
std::string knob_table(const KnobResults& knob) {
  std::string html = "<div class=\"scroll values\" tabindex=\"0\" role=\"region\" aria-label=\"Values of " +
                     escaped(knob.name) + "\"><table><thead><tr>";
  html += "<th scope=\"col\">Value</th><th scope=\"col\" class=\"number\">Ratio</th>";
  if (shows_flip(knob))
    for (const char* title : {"FLIP", "p99", "at edges"})
      html += "<th scope=\"col\" class=\"number\">" + std::string(title) + "</th>";
  else
    html += "<th scope=\"col\">Error</th>";
  html += "<th scope=\"col\">Notes</th></tr></thead><tbody>\n";
  for (const LedgerRow* row : knob.rows) html += value_row(knob, *row);
  return html + "</tbody></table></div>\n";
}

/// The value that is best near edges, for antialiasing, and if the mean over the picture prefers another one.
std::string edge_verdict(const KnobResults& knob) {
  const LedgerRow* by_mean = nullptr;
  const LedgerRow* by_edges = nullptr;
  for (const LedgerRow* row : knob.rows) {
    if (!row->flip || !row->edges || row->counted || !row->wrong.empty()) continue;
    if (by_mean == nullptr || row->flip->mean < by_mean->flip->mean) by_mean = row;
    if (by_edges == nullptr || row->edges->psnr_db > by_edges->edges->psnr_db) by_edges = row;
  }
  if (by_edges == nullptr || (by_edges == by_mean && by_edges->reference_kind != "accumulated")) return {};
  const LedgerRow& other = by_edges != by_mean || knob.standard == nullptr ? *by_mean : *knob.standard;
  if (&other == by_edges || !other.edges) return {};
  const double gain_db = by_edges->edges->psnr_db - other.edges->psnr_db;
  if (!std::isfinite(gain_db) || gain_db < kVisibleGain_db) return {};
  return formatted("<p>At edges, %.0f %% of the picture, <code>", 100.0 * by_edges->edges->share) +
         escaped(by_edges->value) + "</code> is nearer to the reference than <code>" + escaped(other.value) +
         formatted("</code> by %.1f dB (PSNR); FLIP at edges is ", gain_db) + number_text(by_edges->edges->flip.mean) +
         " (p99 " + number_text(by_edges->edges->flip.p99) + ") and " + number_text(other.edges->flip.mean) + " (p99 " +
         number_text(other.edges->flip.p99) + ").</p>\n";
}

/// What the knob's cheapest right value would give back.
std::string knob_gain(const KnobResults& knob) {
  const LedgerRow* cheapest = nullptr;
  for (const LedgerRow* row : knob.rows)
    if (row->wrong.empty() && (cheapest == nullptr || row->ratio < cheapest->ratio)) cheapest = row;
  if (knob.standard == nullptr || cheapest == nullptr) return {};
  if (knob.rows.size() == 1) return "<p>Only its default was measured.</p>\n";
  if (cheapest->is_default || cheapest->ratio_high >= 1.0)
    return "<p>No value is significantly cheaper than the default.</p>\n";
  return "<p>The cheapest value, <code>" + escaped(cheapest->value) + "</code>, takes " + ratio_text(*cheapest) +
         " of the frame’s time and gives back " + ms_text(knob.standard->ms.median_ms * (1.0 - cheapest->ratio)) +
         (cheapest->error() ? "; error " + escaped(error_text_of(*cheapest)) : "") + ".</p>\n";
}

std::string knob_article(const KnobResults& knob) {
  std::string html = "<article class=\"knob\">\n<h4><code>" + escaped(knob.name) + "</code></h4>\n";
  if (!knob.meaning.empty()) html += "<p class=\"meaning\">" + escaped(knob.meaning) + "</p>\n";
  html += knob_gain(knob) + edge_verdict(knob);
  const LedgerRow& first = *knob.rows.front();
  html += "<p class=\"reference\">" +
          (first.reference_kind.empty()
               ? "No reference: " + escaped(no_reference_text(first)) + "."
               : "Reference: " + escaped(reference_text(first)) +
                     (first.reference_noise > 0.0 ? "; its own noise is " + number_text(first.reference_noise) : "") +
                     ".") +
          "</p>\n";
  if (knob.rows.size() > 1)
    html += "<div class=\"chart-and-table\">" + error_plot(knob) + knob_table(knob) + "</div>\n";
  return html + "</article>\n";
}

/// The heading of a module and what it takes at its default.
std::string module_heading(const ReportData& data, std::string_view module) {
  std::string html = "<h3>" + escaped(module) + "</h3>\n";
  for (const KnobResults& knob : data.knobs) {
    if (knob.standard == nullptr || module_of(knob.name) != module) continue;
    const LedgerRow& row = *knob.standard;
    if (row.module_cpu_ms + row.module_gpu_ms == 0.0) return html;
    return html + "<p>At the default of its knobs: " + ms_text(row.module_cpu_ms) +
           " in its systems (all threads) and " + ms_text(row.module_gpu_ms) +
           " in its passes, as clocks on the wall show them, in a frame of " + ms_text(row.ms.median_ms) + ".</p>\n";
  }
  return html;
}

std::string folded_knobs(const ReportData& data) {
  std::string list;
  std::size_t count = 0;
  for (const KnobResults& knob : data.knobs) {
    if (!knob.no_effect) continue;
    const std::string reason = knob.standard == nullptr ? "" : knob.standard->no_effect_reason;
    list += "<li><code>" + escaped(knob.name) + "</code> (" + std::to_string(knob.rows.size()) + " values)" +
            (reason.empty() ? "" : ": " + escaped(reason)) + "</li>\n";
    ++count;
  }
  if (count == 0) return {};
  return "<details><summary>Knobs without effect in this scene: " + std::to_string(count) +
         "</summary>\n<p>The pictures of all their values are equal to the bit, and no difference in time is "
         "significant. Where the reason was known before, times were not measured.</p>\n<ul>\n" +
         list + "</ul></details>\n";
}

}  // namespace

std::string effects_section(const ReportData& data) {
  std::string html =
      "<section id=\"effects\" aria-labelledby=\"effects-title\">\n<h2 id=\"effects-title\">Each effect</h2>\n";
  html +=
      "<p class=\"keys\">In the plots: a square surrounds the default; a diamond is equal to its reference; blue "
      "points are "
      "on the front, joined by a line: no other value is as cheap and as right; a cross is wrong. Whiskers are 95 % "
      "intervals of the time. Dashed lines are the bounds 0.01, 0.03 and 0.1. A point shows its picture beside the "
      "default’s. In the tables: p99 is the 99th percentile over the pixels; at edges is mean FLIP over the pixels "
      "within two of an edge of the reference, which a mean over the picture hides.</p>\n";
  std::vector<std::string_view> modules;  // in the order of their first knobs
  for (const KnobResults& knob : data.knobs)
    if (!knob.no_effect && std::ranges::find(modules, module_of(knob.name)) == modules.end())
      modules.push_back(module_of(knob.name));
  for (const std::string_view module : modules) {
    html += module_heading(data, module);
    for (const KnobResults& knob : data.knobs)
      if (!knob.no_effect && module_of(knob.name) == module) html += knob_article(knob);
  }
  if (modules.empty()) html += "<p class=\"empty\">No measured knob changes anything in this scene.</p>\n";
  return html + folded_knobs(data) + "</section>\n";
}

}  // namespace gloam
