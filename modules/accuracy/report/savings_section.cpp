// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

std::string saving_error(const Saving& saving) {
  if (!saving.row->picture.empty() && saving.row->picture == saving.standard->picture)
    return "The picture is equal to the default’s to the bit.";
  std::string text = sentence(error_words(*saving.row));
  if (const auto now = flip_error(*saving.standard)) text += "; error of the default: " + number_text(*now);
  if (saving.row->counted) text += "; FLIP " + number_text(*flip_error(*saving.row));
  return escaped(text) + ".";
}

std::string saving_figure(const ReportData& data, const LedgerRow& row, const std::string& caption) {
  return "<figure>" + picture_html(data, row.picture, "The scene with " + setting_of(row)) + "<figcaption>" +
         escaped(caption) + "</figcaption></figure>";
}

std::string saving_card(const ReportData& data, const Saving& saving, const KnobResults& knob) {
  const LedgerRow& row = *saving.row;
  const double saved_ms = saving.standard->ms.median_ms * (1.0 - row.ratio);
  std::string html = "<li class=\"card\">\n<h4><code>" + escaped(row.knob) + "</code> " +
                     escaped(saving.standard->value) + " → <strong>" + escaped(row.value) + "</strong></h4>\n";
  if (!knob.meaning.empty()) html += "<p class=\"meaning\">" + escaped(knob.meaning) + "</p>\n";
  html += "<p><strong class=\"gain\">" + ratio_text(row) + "</strong> of the frame’s time; gives back " +
          ms_text(saved_ms) + " of " + ms_text(saving.standard->ms.median_ms) + ".</p>\n";
  html += "<p>" + saving_error(saving) + "</p>\n";
  html += "<div class=\"pair\">" + saving_figure(data, *saving.standard, "default: " + saving.standard->value) +
          saving_figure(data, row, row.value) + "</div>\n";
  html += "<p class=\"do\"><code>--set " + escaped(setting_of(row)) + "</code> " +
          look_link(row, saving.standard, "Compare under a slider",
                    "aria-label=\"Compare under a slider: the default and " + escaped(setting_of(row)) + "\"") +
          "</p>\n";
  return html + "</li>\n";
}

std::string saving_list(const ReportData& data, const std::vector<Saving>& list, std::string_view title,
                        std::string_view explanation) {
  if (list.empty()) return {};
  std::string html = "<h3>" + std::string(title) + "</h3>\n<p>" + std::string(explanation) + "</p>\n";
  html += "<ul class=\"cards\">\n";
  for (const Saving& saving : list)
    for (const KnobResults& knob : data.knobs)
      if (knob.standard == saving.standard) html += saving_card(data, saving, knob);
  return html + "</ul>\n";
}

}  // namespace

std::string savings_section(const ReportData& data) {
  std::string html = "<section id=\"turn-down\" aria-labelledby=\"turn-down-title\">\n";
  html += "<h2 id=\"turn-down-title\">" +
          std::string(data.ledger.points.empty() ? "What to turn down" : "One knob at a time") + "</h2>\n";
  html +=
      "<p>Values that take significantly less time than the default (their 95 % interval ends below 1). Every value "
      "was "
      "measured alone, so the savings of several do not simply add up. Errors are mean FLIP against each knob’s "
      "reference: below 0.01 nobody sees it side by side, 0.03 is seen when flipping between the pictures, 0.1 is seen "
      "at once.</p>\n";
  const Savings& savings = data.savings;
  html += saving_list(data, savings.no_less_right, "No less right than the default",
                      "Cheaper, with an error no greater than the default’s: nothing is given up.");
  html += saving_list(data, savings.below_001, "Error below 0.01",
                      "Nobody sees it side by side with the reference, but for the worst places where the "
                      "99th percentile (p99) reaches 0.1.");
  html += saving_list(data, savings.below_003, "Error below 0.03",
                      "Cheaper than what the lists above offer for the same knob; seen at most when flipping.");
  if (savings.no_less_right.empty() && savings.below_001.empty() && savings.below_003.empty())
    html += "<p class=\"empty\">No measured value gives back time at an error below 0.03.</p>\n";
  return html + "</section>\n";
}

}  // namespace gloam
