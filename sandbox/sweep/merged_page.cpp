// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string_view>

#include "engine/core/text/formatted.h"
#include "sandbox/sweep/merged_ledgers.h"

namespace gloam {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; }
body { margin: 0 auto; max-width: 76rem; padding: 0 1.25rem 3rem; font: 1rem/1.5 system-ui, "DejaVu Sans", sans-serif; }
h2 { margin-top: 2rem; border-top: 2px solid #8a949e; padding-top: .75rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .92rem; margin: .5rem 0 1.5rem; }
caption { text-align: left; font-weight: 600; padding: .25rem 0; }
th, td { text-align: left; padding: .25rem .7rem; border-bottom: 1px solid #8a949e; font-weight: normal; }
thead th { font-weight: 600; }
.number { text-align: right; }
@media (prefers-color-scheme: dark) { a { color: #7db8f5; } body { background: #14171a; color: #e6e9ec; } }
)css";

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return html;
}

/// A path as a relative link.
std::string link_text(const std::filesystem::path& path) {
  std::string text;
  for (const char c : path.generic_string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-_./~").find(c) != std::string_view::npos;
    text += plain ? std::string(1, c) : formatted("%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return text;
}

std::string text_cell(const std::string& text) { return "<td>" + escaped(text) + "</td>"; }
std::string number_cell(const std::string& text) { return "<td class=\"number\">" + text + "</td>"; }

std::string sentences(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string html = "<h2>" + std::string(title) + "</h2>\n<ul>\n";
  for (const std::string& line : lines) html += "<li>" + escaped(line) + "</li>\n";
  return html + "</ul>\n";
}

const LedgerRow* default_row(const Ledger& ledger) {
  for (const LedgerRow& row : ledger.rows)
    if (row.is_default) return &row;
  return nullptr;
}

std::string ledgers_table(const LedgerGroup& group, const std::string& folder) {
  std::string html =
      "<div class=\"wide\"><table><caption>Scenes</caption><thead><tr><th scope=\"col\">Scene</th><th "
      "scope=\"col\">Camera</th><th scope=\"col\">Pixels</th><th scope=\"col\" class=\"number\">Rows</th><th "
      "scope=\"col\" class=\"number\">Default, ms</th><th scope=\"col\">Folder</th></tr></thead><tbody>\n";
  for (const FoundLedger* found : group.ledgers) {
    const LedgerHeader& header = found->ledger.header;
    const std::filesystem::path report = std::filesystem::path(found->folder) / "report.html";
    std::error_code absent;
    const std::filesystem::path target = std::filesystem::proximate(report, folder, absent);
    const bool linked = std::filesystem::exists(report, absent);
    const std::string scene = escaped(header.scene);
    html += "<tr><th scope=\"row\">" +
            (linked ? "<a href=\"" + link_text(target) + "\">" + scene + "</a>" : scene + " (no report)") + "</th>";
    html += text_cell(header.camera.empty() ? "the first" : header.camera);
    html += text_cell(formatted("%u × %u", header.width, header.height) + (header.quick ? ", quick" : ""));
    const LedgerRow* standard = default_row(found->ledger);
    html += number_cell(std::to_string(found->ledger.rows.size()));
    html += number_cell(standard != nullptr ? formatted("%.2f", standard->ms.median_ms) : "") + text_cell(found->name) +
            "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string values_table(const LedgerGroup& group) {
  std::string html =
      "<div class=\"wide\"><table><caption>Values over the scenes</caption><thead><tr><th scope=\"col\">Value</th><th "
      "scope=\"col\" class=\"number\">Scenes</th><th scope=\"col\" class=\"number\">Time ratio, mean</th><th "
      "scope=\"col\" class=\"number\">Time ratio, worst</th><th scope=\"col\" class=\"number\">FLIP, worst</th><th "
      "scope=\"col\">in</th></tr></thead><tbody>\n";
  for (const ValueSummary& value : summarize_values(group)) {
    html += "<tr><th scope=\"row\">" + escaped(value.knob + "=" + value.value) + "</th>";
    html += number_cell(std::to_string(value.ledgers)) + number_cell(formatted("%.2f", value.mean_ratio));
    html += number_cell(formatted("%.2f", value.worst_ratio));
    html += number_cell(value.worst_flip ? formatted("%.4f", *value.worst_flip) : "–") + text_cell(value.worst_in);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string merged_page(const MergedLedgers& merged, const std::string& folder) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n<title>Costs of a "
      "sweep</title>\n<style>";
  html += kStyle;
  html += "</style>\n</head>\n<body>\n<main>\n<h1>Costs of a sweep</h1>\n";
  if (merged.groups.size() > 1)
    html +=
        "<p>Times of different hosts, devices or builds are not comparable: each has a section with tables of its "
        "own.</p>\n";
  html += sentences("Missing", merged.missing) + sentences("Duplicates", merged.duplicates);
  for (const LedgerGroup& group : merged.groups) {
    const LedgerHeader& header = group.header();
    html += "<h2>" + escaped(header.device) + (header.host.empty() ? "" : " on " + escaped(header.host)) + "</h2>\n";
    html += "<p>" + escaped(header.driver) + "; gloam " + escaped(header.version) + " (" + escaped(header.build) +
            "); times: " + escaped(header.clock) + "</p>\n";
    html += ledgers_table(group, folder) + values_table(group);
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace gloam
