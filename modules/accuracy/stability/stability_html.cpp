// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"
#include "modules/accuracy/stability.h"

namespace gloam {
namespace {

// In units of the SVG.
constexpr double kWidth = 560.0;
constexpr double kHeight = 220.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 545.0;
constexpr double kTop = 16.0;
constexpr double kBottom = 170.0;

/// An axis from `low` at `from` to `high` at `to`, logarithmic over more than a factor of 50.
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double from = 0.0;
  double to = 1.0;

  [[nodiscard]] bool is_log() const { return low > 0.0 && high > 50.0 * low; }
  [[nodiscard]] double at(double value) const {
    if (!(high > low)) return 0.5 * (from + to);
    const double share = is_log() ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return from + (to - from) * std::clamp(share, 0.0, 1.0);
  }
};

Axis x_axis(const StabilityCheck& check) {
  const auto [low, high] = std::ranges::minmax(check.curve, {}, &StabilityPoint::at);
  return {low.at, high.at, kLeft, kRight};
}

/// Errors up to four bounds; what is above is drawn at the top.
Axis y_axis(const StabilityCheck& check) {
  double most = 1.25 * check.bound;
  for (const StabilityPoint& point : check.curve)
    if (std::isfinite(point.error)) most = std::max(most, std::min(point.error, 4.0 * check.bound));
  return {0.0, most > 0.0 ? most : 1.0, kBottom, kTop};
}

std::string line(double x0, double y0, double x1, double y1, const char* attributes) {
  return formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>", x0, y0, x1, y1, attributes);
}

std::string text(double x, double y, const char* anchor, const std::string& content) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + escaped(content) + "</text>";
}

std::string description(const StabilityCheck& check) {
  std::string words = check.name + ": error against " + check.axis + ". ";
  for (const StabilityPoint& point : check.curve)
    words += number_text(point.at) + ": " + number_text(point.error) + "; ";
  return words + "bound " + number_text(check.bound) + " " + check.unit + ".";
}

std::string plot(const StabilityCheck& check) {
  const Axis x = x_axis(check), y = y_axis(check);
  std::string svg =
      formatted("<svg class=\"plot limits\" viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"", kWidth, kHeight) +
      escaped(description(check)) + "\">";
  if (check.promised) {
    const double low = x.at(std::max(check.promised->low, x.low)), high = x.at(std::min(check.promised->high, x.high));
    svg += formatted("<rect class=\"promised\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>", low, kTop,
                     std::max(high - low, 2.0), kBottom - kTop);
  }
  svg += line(kLeft, kBottom, kRight, kBottom, "class=\"axis\"") + line(kLeft, kTop, kLeft, kBottom, "class=\"axis\"");
  svg += line(kLeft, y.at(check.bound), kRight, y.at(check.bound), "class=\"bound\"");
  svg += text(kLeft - 6.0, y.at(check.bound) + 4.0, "end", number_text(check.bound));
  svg += text(kLeft - 6.0, kBottom + 4.0, "end", "0");
  std::string points;
  for (const StabilityPoint& point : check.curve) {
    const double height = std::isfinite(point.error) ? y.at(point.error) : kTop;
    points += formatted("%.1f,%.1f ", x.at(point.at), height);
    const bool fits = std::isfinite(point.error) && point.error <= check.bound;
    svg += formatted("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>", fits ? "fits" : "beyond", x.at(point.at),
                     height);
  }
  svg += "<polyline class=\"curve\" points=\"" + points + "\"/>";
  svg += text(kLeft, kBottom + 18.0, "middle", number_text(x.low)) +
         text(kRight, kBottom + 18.0, "end", number_text(x.high));
  return svg + text(0.5 * (kLeft + kRight), kBottom + 38.0, "middle", check.axis) + "</svg>";
}

std::string result_cell(const StabilityCheck& check) {
  if (!check.skipped.empty()) return "<td>skipped: " + escaped(check.skipped) + "</td>";
  if (!check.fault.empty()) return "<td class=\"wrong\">failed: " + escaped(check.fault) + "</td>";
  if (holds(check)) return "<td>holds</td>";
  return "<td class=\"wrong\">failed. " + escaped(check.advice) + "</td>";
}

std::string table(const StabilityReport& report, StabilityKind kind) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Checks\"><table "
      "class=\"checks\"><thead><tr><th "
      "scope=\"col\">Check</th>"
      "<th scope=\"col\">Worst</th><th scope=\"col\">Bound</th><th scope=\"col\">Where</th><th "
      "scope=\"col\">Result</th>"
      "</tr></thead><tbody>";
  for (const StabilityCheck& check : report.checks) {
    if (check.kind != kind) continue;
    const bool measured = check.skipped.empty() && check.fault.empty();
    html += "<tr><th scope=\"row\"><code>" + escaped(check.name) + "</code><br><span class=\"meaning\">" +
            escaped(sentence(check.sentence)) + "</span></th><td>" +
            (measured ? number_text(check.worst) + " " + escaped(check.unit) : std::string("–")) + "</td><td>" +
            number_text(check.bound) + "</td><td>" + escaped(check.worst_case) + "</td>" + result_cell(check) + "</tr>";
  }
  return html + "</tbody></table></div>";
}

std::string curves(const StabilityReport& report) {
  std::string html;
  for (const StabilityCheck& check : report.checks) {
    if (check.kind != StabilityKind::curve || check.curve.empty()) continue;
    html += "<h3><code>" + escaped(check.name) + "</code></h3><p>" + escaped(sentence(check.sentence)) + ".";
    if (check.promised)
      html +=
          " It must hold from " + number_text(check.promised->low) + " to " + number_text(check.promised->high) + ".";
    if (const auto range = range_within_bound(check))
      html += " It holds from " + number_text(range->low) + " to " + number_text(range->high) + ".";
    html += "</p>" + plot(check);
  }
  return html;
}

constexpr const char* kPlotsMeaning =
    "<p>The dashed line is the bound, and the area behind is where it must hold. An error above four bounds is drawn "
    "at "
    "the top.</p>";

}  // namespace

const std::string_view kStabilityStyle = R"css(
.limits text { fill: var(--soft); font-size: 13px; }
.limits .axis { stroke: var(--soft); } .limits .bound { stroke: var(--bound); stroke-dasharray: 6 4; stroke-width: 2; }
.limits .curve { fill: none; stroke: var(--front); stroke-width: 2; } .limits .promised { fill: var(--line); opacity: .45; }
.limits .fits { fill: var(--front); } .limits .beyond { fill: var(--wrong); }
.checks td, .checks th { text-align: left; vertical-align: top; padding: .3rem .7rem .3rem 0; white-space: normal; }
.checks .wrong { color: var(--wrong); font-weight: 600; }
)css";

std::string stable_section(const ReportData& data) {
  std::string html = "<section aria-labelledby=\"stable\">\n<h2 id=\"stable\" tabindex=\"-1\">Stable</h2>\n";
  if (data.stability == nullptr)
    return html +
           "<p>Whether the mathematics holds on this device, and how far, says <code>gloam selftest</code>. It has not "
           "been run here yet.</p>\n</section>\n";
  const StabilityReport& report = *data.stability;
  const std::size_t failed = failed_checks(report);
  html += formatted("<p>%zu of %zu checks of <code>gloam selftest</code> hold on ", report.checks.size() - failed,
                    report.checks.size()) +
          escaped(report.device) + (report.quick ? " (a quick run)" : "") + ".</p>\n";
  if (failed > 0) {
    html += "<ul>";
    for (const StabilityCheck& check : report.checks)
      if (!holds(check)) html += "<li><code>" + escaped(check.name) + "</code>: " + escaped(check.advice) + "</li>";
    html += "</ul>\n";
  }
  return html + "<details><summary>How far each effect holds</summary>" + kPlotsMeaning + curves(report) +
         "</details>\n</section>\n";
}

std::string stability_html(const StabilityReport& report) {
  const std::size_t failed = failed_checks(report);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>Self-test of gloam</title><style>";
  html.append(kPageStyle).append(kStabilityStyle).append("</style></head><body><main><h1>Self-test</h1><p>");
  html += escaped(report.device) + ", " + escaped(report.driver) + ", gloam " + escaped(report.gloam) +
          (report.quick ? ", quick" : "") +
          formatted(", %zu checks in %.0f s.</p>", report.checks.size(), report.seconds);
  html += failed == 0 ? "<p class=\"answer\">Everything holds.</p>"
                      : formatted("<p class=\"answer\">%zu of %zu checks failed.</p>", failed, report.checks.size());
  html += "<h2>Kernels</h2>" + table(report, StabilityKind::kernel);
  html += "<h2>Pictures that must be equal</h2>" + table(report, StabilityKind::invariance);
  html += "<h2>How far it holds</h2>" + table(report, StabilityKind::curve);
  html +=
      "<p>In the plots, the dashed line is the bound, and the area behind is where it must hold. An error above four "
      "bounds is drawn at the top.</p>";
  return html + curves(report) + "</main></body></html>\n";
}

}  // namespace gloam
