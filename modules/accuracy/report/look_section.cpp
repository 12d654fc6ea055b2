// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <set>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

std::string areas_text(const LedgerRow& row) {
  std::string text;
  for (const PictureArea& area : row.worst) {
    for (const std::uint32_t number : {area.x, area.y, area.width, area.height}) text += std::to_string(number) + " ";
    text.back() = ';';
  }
  if (!text.empty()) text.pop_back();
  return text;
}

std::string row_option(const ReportData& data, const LedgerRow& row) {
  const auto known = [&](const std::string& name) { return data.has_picture(name) ? escaped(name) : std::string(); };
  std::string note = row.is_default ? std::string("the default") : ratio_text(row) + " of the default’s time";
  note += "; error " + error_text_of(row);
  if (row.counted && row.flip) note += "; FLIP " + number_text(*flip_error(row));
  if (!row.wrong.empty()) note += "; wrong: " + row.wrong;
  return "<option value=\"" + escaped(setting_of(row)) + "\" data-picture=\"" + known(row.picture) + "\" data-heat=\"" +
         known(row.heat_map()) + "\" data-worst=\"" + known(row.worst_areas()) + "\" data-areas=\"" + areas_text(row) +
         "\" data-note=\"" + escaped(note) + "\">" +
         escaped(setting_of(row) + (row.is_default && setting_of(row) != "default" ? " (default)" : "")) +
         "</option>\n";
}

std::string reference_option(const ReportData& data, const LedgerRow& row) {
  if (!data.has_picture(row.reference_picture)) return {};
  const std::string text = "reference: " + reference_text(row);
  return "<option value=\"reference " + escaped(row.reference_picture) + "\" data-picture=\"" +
         escaped(row.reference_picture) + "\" data-heat=\"\" data-worst=\"\" data-areas=\"\" data-note=\"" +
         escaped(text) + "\">" + escaped(text) + "</option>\n";
}

/// Combinations and the whole frame.
std::string point_options(const ReportData& data) {
  std::string html;
  for (const LedgerPoint& point : data.ledger.points)
    if (data.has_picture(point.measured.picture)) html += row_option(data, point.measured);
  if (html.empty()) return {};
  return "<optgroup label=\"combinations\">\n" + html + reference_option(data, data.ledger.points.front().measured) +
         "</optgroup>\n";
}

/// Values and references, a group for each knob.
std::string picture_options(const ReportData& data) {
  std::string html = point_options(data);
  for (const KnobResults& knob : data.knobs) {
    html += "<optgroup label=\"" + escaped(knob.name) + (knob.no_effect ? " (no effect)" : "") + "\">\n";
    std::set<std::string> references;
    for (const LedgerRow* row : knob.rows)
      if (data.has_picture(row->picture)) html += row_option(data, *row);
    for (const LedgerRow* row : knob.rows)
      if (references.insert(row->reference_picture).second) html += reference_option(data, *row);
    html += "</optgroup>\n";
  }
  return html;
}

/// The comparison that is shown first: the recommendation, or else the greatest saving, or else the first value that
/// differs from its default.
std::string first_comparison(const ReportData& data) {
  const LedgerRow* standard = nullptr;
  const LedgerRow* row = nullptr;
  if (data.recommended != nullptr && data.users != nullptr) {
    row = &data.recommended->measured;
    standard = &data.users->measured;
  }
  for (const auto* list : {&data.savings.below_003, &data.savings.below_001, &data.savings.no_less_right}) {
    if (list->empty() || data.recommended != nullptr) continue;
    row = list->front().row;
    standard = list->front().standard;
  }
  for (const KnobResults& knob : data.knobs) {
    for (const LedgerRow* other : knob.rows) {
      if (row != nullptr || knob.standard == nullptr || other->picture == knob.standard->picture) continue;
      row = other;
      standard = knob.standard;
    }
  }
  if (row == nullptr) return {};
  return " data-left=\"" + escaped(setting_of(*standard)) + "\" data-right=\"" + escaped(setting_of(*row)) + "\"";
}

constexpr std::string_view kViewer = R"html(<img id="left-picture" alt=""><img id="right-picture" alt="">
<span class="corner left" aria-hidden="true">left</span><span class="corner right" aria-hidden="true">right</span>
<div class="bar" aria-hidden="true"></div>
</div>
<p><label for="slider">Border between left and right</label>
<input type="range" id="slider" min="0" max="100" value="50" aria-valuetext="50 % left"></p>
<p id="look-note" aria-live="polite"></p>
<div class="errors">
<figure id="heat-figure" hidden><div class="heat"><img id="heat-picture" alt=""></div>
<figcaption>FLIP of the right picture against its reference<span class="legend" role="img"
 aria-label="Colours from black, 0, through violet, orange at about a half, to pale yellow, 1"></span>
<span class="legend-text" aria-hidden="true"><span style="left:0">0</span><span style="left:10%">0.01</span>
<span style="left:31.6%">0.1</span><span style="left:54.8%">0.3</span><span style="left:100%">1</span></span></figcaption></figure>
<figure id="worst-figure" hidden><img id="worst-picture" alt=""><figcaption>Where it is wrong, four times as large: the right
picture on the left, its reference beside it; the worst area first</figcaption></figure>
</div>
)html";

}  // namespace

std::string look_section(const ReportData& data) {
  std::string html = "<section id=\"look\" aria-labelledby=\"look-title\"" + first_comparison(data) +
                     ">\n<h2 id=\"look-title\" tabindex=\"-1\">Look</h2>\n";
  const std::string options = picture_options(data);
  if (options.find("<option ") == std::string::npos)
    return html + "<p class=\"empty\">There are no pictures.</p>\n</section>\n";
  html +=
      "<noscript><p>The pictures are in the folder <code>pictures</code>; comparing them here needs "
      "JavaScript.</p></noscript>\n";
  html += "<div class=\"pickers\">\n";
  for (const std::string side : {"left", "right"})
    html += "<p><label for=\"" + side + "\">" + (side == "left" ? "Left" : "Right") + "</label> <select id=\"" + side +
            "\">\n" + (side == "left" ? options : std::string()) + "</select> <a id=\"" + side +
            "-full\" href=\"#look\">full size</a></p>\n";
  html += "</div>\n";
  const LedgerHeader& header = data.ledger.header;
  html += formatted("<div class=\"compare\" id=\"compare\" data-width=\"%u\" data-height=\"%u\">\n", header.width,
                    header.height);
  html += kViewer;
  return html + "</section>\n";
}

}  // namespace gloam
