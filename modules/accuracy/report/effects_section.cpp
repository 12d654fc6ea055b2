// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

/// Marks of a row in words.
std::string row_notes(const LedgerRow& row) {
  std::string notes;
  const auto add = [&](const std::string& note) { notes += (notes.empty() ? "" : ", ") + note; };
  if (row.is_default) add("default");
  if (row.on_front) add("on the front");
  if (row.reference_kind == "brute force" && row.reference_name == setting_of(row)) add("exact");
  if (row.no_effect && !row.is_default) add("no effect");
  if (!row.wrong.empty()) add("wrong: " + row.wrong);
  return notes;
}

std::string knob_table(const KnobResults& knob) {
  std::string html =
      "<table class=\"values\"><thead><tr><th scope=\"col\">Value</th><th scope=\"col\">Time, ratio</th>"
      "<th scope=\"col\">Error</th><th scope=\"col\">Notes</th></tr></thead><tbody>\n";
  for (const LedgerRow* row : knob.rows) {
    html += "<tr><th scope=\"row\">" + look_link(*row, knob.standard, escaped(row->value)) + "</th><td>" +
            ratio_text(*row) + "</td><td>" + escaped(error_text_of(*row)) + "</td><td>" + escaped(row_notes(*row)) +
            "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

/// What the knob's cheapest right value would give back.
std::string knob_gain(const KnobResults& knob) {
  const LedgerRow* cheapest = nullptr;
  for (const LedgerRow* row : knob.rows)
    if (row->wrong.empty() && (cheapest == nullptr || row->ratio < cheapest->ratio)) cheapest = row;
  if (knob.standard == nullptr || cheapest == nullptr) return {};
  if (cheapest->is_default || cheapest->ratio_high >= 1.0)
    return "<p>No value is significantly cheaper than the default.</p>\n";
  return "<p>The cheapest value, <code>" + escaped(cheapest->value) + "</code>, takes " + ratio_text(*cheapest) +
         " of the frame’s time and gives back " + ms_text(knob.standard->ms.median_ms * (1.0 - cheapest->ratio)) +
         (cheapest->error() ? "; error " + escaped(error_text_of(*cheapest)) : "") + ".</p>\n";
}

std::string knob_article(const KnobResults& knob) {
  std::string html = "<article class=\"knob\">\n<h4><code>" + escaped(knob.name) + "</code></h4>\n";
  if (!knob.meaning.empty()) html += "<p class=\"meaning\">" + escaped(knob.meaning) + "</p>\n";
  html += knob_gain(knob);
  const LedgerRow& first = *knob.rows.front();
  html += "<p class=\"reference\">" +
          (first.reference_kind.empty()
               ? "No reference: " + escaped(no_reference_text(first)) + "."
               : "Reference: " + escaped(first.reference_kind + ", " + first.reference_name) +
                     (first.reference_noise > 0.0 ? "; its own noise is " + number_text(first.reference_noise) : "") +
                     ".") +
          "</p>\n";
  html += "<div class=\"chart-and-table\">" + error_plot(knob) + knob_table(knob) + "</div>\n";
  return html + "</article>\n";
}

/// The heading of a module and what it takes at its default.
std::string module_heading(const ReportData& data, std::string_view module) {
  std::string html = "<h3>" + escaped(module) + "</h3>\n";
  for (const KnobResults& knob : data.knobs) {
    if (knob.standard == nullptr || module_of(knob.name) != module) continue;
    const LedgerRow& row = *knob.standard;
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
         "significant.</p>\n<ul>\n" +
         list + "</ul></details>\n";
}

std::string skipped_knobs(const Ledger& ledger) {
  if (ledger.skipped.empty()) return {};
  std::string html = "<details><summary>Knobs that were not measured, because the scene does not call for them: " +
                     std::to_string(ledger.skipped.size()) + "</summary>\n<ul>\n";
  for (const SkippedKnob& skipped : ledger.skipped)
    html += "<li><code>" + escaped(skipped.knob) + "</code>: " + escaped(skipped.reason) + "</li>\n";
  return html + "</ul></details>\n";
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
      "default’s.</p>\n";
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
  return html + folded_knobs(data) + skipped_knobs(data.ledger) + "</section>\n";
}

}  // namespace gloam
