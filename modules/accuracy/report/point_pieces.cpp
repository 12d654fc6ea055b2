// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

// Pieces that show a combination of values.

namespace gloam {
namespace {

/// Percent-encoded, for a data: URI.
std::string uri_text(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::string encoded;
  for (const char c : text)
    encoded += kPlain.find(c) != std::string_view::npos ? std::string(1, c)
                                                        : formatted("%%%02X", static_cast<unsigned char>(c));
  return encoded;
}

}  // namespace

std::string point_time(const ReportData& data, const LedgerPoint& point) {
  const LedgerRow& row = point.measured;
  if (row.is_default || data.users == nullptr) return ms_text(row.ms.median_ms);
  const double users = data.users->measured.ms.median_ms;
  return ms_text(row.ms.median_ms) + " (" + number_text(users * row.ratio_low) + "–" +
         number_text(users * row.ratio_high) + ")";
}

std::string settings_list(const ReportData& data, const LedgerPoint& point, bool with_meaning) {
  if (point.settings.empty()) return "<p>All knobs are at their defaults.</p>\n";
  std::string html = "<ul>\n";
  for (const KnobValue& setting : point.settings) {
    const auto known = std::ranges::find(data.meanings, setting.knob, &KnobMeaning::knob);
    const bool has_default = known != data.meanings.end() && !known->default_value.empty();
    const std::string from = has_default ? known->default_value + " → " : std::string();
    html += "<li><code>" + escaped(setting.knob) + "</code> " + escaped(from) + "<strong>" + escaped(setting.value) +
            "</strong>";
    if (with_meaning && known != data.meanings.end() && !known->meaning.empty())
      html += " <span class=\"meaning\">" + escaped(known->meaning) + "</span>";
    html += "</li>\n";
  }
  return html + "</ul>\n";
}

std::string settings_file(const ReportData& data, const LedgerPoint& point, const std::string& id,
                          const std::string& title) {
  const LedgerRow& row = point.measured;
  const LedgerRow* users = data.users == nullptr ? nullptr : &data.users->measured;
  const std::string config = settings_config(point.settings);
  const std::string label = escaped("settings: " + title);
  return "<p class=\"do\">" +
         look_link(row, users, "Compare under a slider",
                   "aria-label=\"Compare under a slider: your settings and " + escaped(setting_of(row)) + "\"") +
         " <button type=\"button\" data-copy=\"" + id + "\" aria-label=\"Copy " + label +
         "\">Copy settings</button> <a href=\"data:application/json," + uri_text(config) + "\" download=\"" + id +
         ".json\" aria-label=\"Download " + label + "\">Download settings</a></p>\n<details><summary>The file for " +
         "<code>--config</code></summary>\n<pre tabindex=\"0\" role=\"region\" aria-label=\"File of " + label +
         "\"><code id=\"" + id + "\">" + escaped(config) + "</code></pre></details>\n";
}

}  // namespace gloam
