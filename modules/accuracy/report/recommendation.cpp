// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

std::string figure(const ReportData& data, const LedgerPoint& point, const std::string& caption) {
  return "<figure>" + picture_html(data, point.measured.picture, "The scene with " + setting_of(point.measured)) +
         "<figcaption>" + caption + "</figcaption></figure>\n";
}

/// What is lost, in words: "nobody sees it side by side".
std::string loss_words(const ReportData& data, const LedgerPoint& point) {
  const ErrorPair& error = *point.measured.flip;
  if (data.users != nullptr && error.mean <= data.users->measured.flip->mean) return "it is no less right than now";
  const std::string words(visibility_words(error));
  return words.starts_with("nobody") ? words : "the difference is " + words;
}

/// Enlarged, because they are small; empty if the pictures are equal.
std::string worst_places(const ReportData& data, const LedgerRow& row) {
  if (!data.has_picture(row.worst_areas())) return {};
  return "<figure class=\"worst\">" +
         picture_html(data, row.worst_areas(), "Where " + setting_of(row) + " is farthest from the exact frame") +
         "<figcaption>where they differ most: these settings, and the exact frame</figcaption></figure>\n";
}

/// Values that are faster and no less right against references other than the whole frame.
std::string single_values(const ReportData& data) {
  std::string list;
  for (const Saving& saving : data.savings.no_less_right)
    list += (list.empty() ? "<code>" : "; <code>") + escaped(setting_of(*saving.row)) + "</code>, " +
            ratio_text(*saving.row) + " of the time";
  if (list.empty()) return {};
  return "<p>Alone, these take less time and are no less right against their own references: " + list +
         ". <a href=\"#turn-down\">One knob at a time</a> shows them.</p>\n";
}

std::string nothing_to_do(const ReportData& data) {
  const std::string singles = single_values(data);
  std::string html = "<p class=\"answer\"><strong>" +
                     std::string(singles.empty() ? "Nothing." : "Single values only.") +
                     "</strong> No measured combination is significantly faster than your settings at an error below "
                     "0.03.</p>\n" +
                     singles;
  if (data.users == nullptr) return html;
  const LedgerRow& users = data.users->measured;
  html +=
      "<div class=\"pair\">" +
      figure(data, *data.users, "your settings: " + ms_text(users.ms.median_ms) + "; " + escaped(error_words(users)));
  return html + "</div>\n";
}

}  // namespace

std::string recommendation(const ReportData& data) {
  if (data.recommended == nullptr || data.users == nullptr)
    return "<div class=\"lead\">" + nothing_to_do(data) + "</div>\n";
  const LedgerRow& row = data.recommended->measured;
  const LedgerRow& users = data.users->measured;
  std::string html = "<div class=\"lead\">\n<p class=\"answer\">With these settings a frame takes <strong>" +
                     ratio_text(row) + "</strong> of the time that it takes now, and <strong>" +
                     loss_words(data, *data.recommended) + "</strong>.</p>\n";
  html += settings_list(data, *data.recommended, true);
  html += "<div class=\"pair and-worst\">" + figure(data, *data.users, "now: " + ms_text(users.ms.median_ms)) +
          figure(data, *data.recommended,
                 "these settings: " + point_time(data, *data.recommended) + "; error " + number_text(row.flip->mean) +
                     ", p99 " + number_text(row.flip->p99) +
                     (users.flip->mean > 0.0 ? " (now: " + number_text(users.flip->mean) + ")" : std::string())) +
          worst_places(data, row) + "</div>\n";
  return html + settings_file(data, *data.recommended, "recommended", "the recommendation") + "</div>\n";
}

}  // namespace gloam
