// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/report_data.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

/// Bytes of a page. Pictures for which it has no room are links.
constexpr std::size_t kMostBytes = 2'990'000;

std::string page_head(const ReportData& data) {
  // The policy forbids every request; pictures are data.
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
      "'unsafe-inline'; "
      "script-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n";
  html += "<title>Cost of " + escaped(data.ledger.header.scene) + "</title>\n<style>\n";
  html.append(kPageStyle).append(kStabilityStyle);
  return html + "</style>\n</head>\n<body>\n";
}

std::string page_header(const ReportData& data) {
  const LedgerHeader& header = data.ledger.header;
  std::string html = "<a class=\"skip\" href=\"#main\">Skip to the content</a>\n<header>\n<h1>What <code>" +
                     escaped(header.scene) + "</code> costs</h1>\n<p>";
  if (!data.knobs.empty() && data.knobs.front().standard != nullptr)
    html += "A frame takes " + ms_text(data.knobs.front().standard->ms.median_ms) + " with the defaults. ";
  html += escaped(header.device) + formatted(", %u × %u pixels", header.width, header.height);
  if (!data.ledger.cameras.empty()) html += formatted("; the worst of %zu cameras", data.ledger.cameras.size());
  if (header.quick) html += "; measured quickly, so errors and times are noisier";
  html +=
      ".</p>\n<nav aria-label=\"Sections\">" +
      std::string(data.ledger.points.empty()
                      ? "<a href=\"#turn-down\">What to turn down</a>"
                      : "<a href=\"#budgets\">What to turn down</a> <a href=\"#turn-down\">One knob at a time</a>") +
      " <a href=\"#effects\">Each effect</a> <a href=\"#look\">Look</a> ";
  if (!data.ledger.skipped.empty()) html += "<a href=\"#called-for\">Called for</a> ";
  if (!data.ledger.cameras.empty()) html += "<a href=\"#cameras\">Cameras</a> ";
  html +=
      "<a href=\"#stable\">Stable</a> <a href=\"#everything\">Everything</a> <a "
      "href=\"#conditions\">Conditions</a></nav>\n";
  return html + "</header>\n";
}

/// The most important pictures as JSON, each once, in at most `room` bytes; the script sets them as sources of images.
std::string page_pictures(const ReportData& data, std::size_t room) {
  std::string html = "<script type=\"application/json\" id=\"pictures\">{";
  bool first = true;
  for (const auto& [name, uri] : data.pictures) {
    // Names are hashes with hyphens; escaping keeps any other text from ending the element or the string.
    const std::string entry = (first ? "\n\"" : ",\n\"") + escaped(name) + "\":\"" + uri + "\"";
    if (entry.size() > room) continue;
    room -= entry.size();
    html += entry;
    first = false;
  }
  return html + "}</script>\n";
}

}  // namespace

std::string ledger_report(const Ledger& ledger, const ReportRequest& request) {
  const ReportData data = report_data(ledger, request);
  std::string html = page_head(data) + page_header(data) + "<main id=\"main\">\n";
  html += budgets_section(data) + savings_section(data);
  html += effects_section(data);
  html += look_section(data);
  html += called_section(data);
  html += cameras_section(data);
  html += stable_section(data);
  html += table_section(data);
  html += conditions_section(data);
  html += "</main>\n";
  const std::string rest = "<script>\n" + std::string(kPageScript) + "</script>\n</body>\n</html>\n";
  const std::size_t used = html.size() + rest.size();
  return html + page_pictures(data, kMostBytes - std::min(used, kMostBytes)) + rest;
}

}  // namespace gloam
