// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {

std::string setting_of(const LedgerRow& row) { return row.knob.empty() ? row.value : row.knob + "=" + row.value; }

std::string look_link(const LedgerRow& row, const LedgerRow* before, std::string_view content,
                      std::string_view attributes) {
  std::string html = "<a href=\"#look-title\" data-right=\"" + escaped(setting_of(row)) + "\"";
  if (before != nullptr) html += " data-left=\"" + escaped(setting_of(*before)) + "\"";
  if (!attributes.empty()) html.append(" ").append(attributes);
  return html.append(">").append(content).append("</a>");
}

std::string picture_html(const ReportData& data, const std::string& name, std::string_view description) {
  const std::string text = escaped(description);
  if (name.empty() || !data.has_picture(name)) return "<span class=\"none\">no picture</span>";
  return "<a href=\"pictures/" + escaped(name) + ".png\"><img data-picture=\"" + escaped(name) + "\" alt=\"" + text +
         "\"></a>";
}

}  // namespace gloam
