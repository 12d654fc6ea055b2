// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

/// Knobs that were not measured for one reason.
struct SkippedGroup {
  std::string_view reason;
  std::vector<std::string_view> knobs;
};

std::vector<SkippedGroup> groups_of(const std::vector<SkippedKnob>& skipped) {
  std::vector<SkippedGroup> groups;
  for (const SkippedKnob& knob : skipped) {
    auto group = std::ranges::find(groups, knob.reason, &SkippedGroup::reason);
    if (group == groups.end()) group = groups.insert(groups.end(), {knob.reason, {}});
    group->knobs.push_back(knob.knob);
  }
  return groups;
}

/// Modules of the measured knobs, in the order of the ledger: "shadows, lighting".
std::string measured_modules(const ReportData& data) {
  std::vector<std::string_view> modules;
  for (const KnobResults& knob : data.knobs)
    if (std::ranges::find(modules, module_of(knob.name)) == modules.end()) modules.push_back(module_of(knob.name));
  std::string text;
  for (const std::string_view module : modules) text += (text.empty() ? "" : ", ") + std::string(module);
  return text;
}

}  // namespace

std::string called_section(const ReportData& data) {
  if (data.ledger.skipped.empty()) return {};
  std::string html =
      "<section id=\"called-for\" aria-labelledby=\"called-for-title\">\n<h2 id=\"called-for-title\">Called for</h2>\n";
  if (const std::string modules = measured_modules(data); !modules.empty())
    html += "<p>Measured: " + escaped(modules) + ".</p>\n";
  html +=
      "<p>Not measured, because these effects take no part in the frames: they have no systems, passes, pipelines or "
      "memory.</p>\n<ul>\n";
  for (const SkippedGroup& group : groups_of(data.ledger.skipped)) {
    html += "<li>" + escaped(sentence(group.reason)) +
            "\n<details><summary>Knobs: " + std::to_string(group.knobs.size()) + "</summary><p>";
    for (const std::string_view& knob : group.knobs)
      html += (&knob == &group.knobs.front() ? "<code>" : ", <code>") + escaped(knob) + "</code>";
    html += "</p></details></li>\n";
  }
  return html + "</ul>\n</section>\n";
}

}  // namespace gloam
