// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstddef>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

std::string camera_name(const CameraRows& camera) {
  return (camera.camera.empty() ? std::string("The first camera") : "Camera " + camera.camera) +
         formatted(" at %g s", camera.time_s);
}

/// Combinations that are on the front over all cameras, as they are in this one.
std::string points_rows(const std::vector<LedgerPoint>& points, std::size_t camera) {
  std::string html;
  for (const LedgerPoint& point : points) {
    const bool named = point.measured.is_default || point.is_exact;
    if (camera >= point.cameras.size() || (!point.measured.on_front && !named)) continue;
    const LedgerRow& row = point.cameras[camera];
    const std::string name = row.is_default ? "The user's own settings" : escaped(settings_text(point.settings));
    html += "<tr><th scope=\"row\">" + (point.is_exact ? "The exact setting: " + name : name) + "</th><td>" +
            escaped(error_text_of(row)) + "</td><td>" + ms_text(row.ms.median_ms) + "</td><td>" + ratio_text(row) +
            "</td></tr>\n";
  }
  return html;
}

std::string camera_table(const CameraRows& camera, const std::string& points) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + escaped(camera_name(camera)) +
      "\"><table><thead><tr><th scope=\"col\">Value</th><th scope=\"col\">Error</th><th scope=\"col\">Time</th><th "
      "scope=\"col\">Of the default's time</th></tr></thead><tbody>\n";
  for (const LedgerRow& row : camera.rows) {
    if (row.no_effect && !row.is_default) continue;
    html += "<tr><th scope=\"row\">" + std::string(row.on_front ? "★ " : "") + escaped(setting_of(row)) + "</th><td>" +
            escaped(error_text_of(row)) + "</td><td>" + ms_text(row.ms.median_ms) + "</td><td>" + ratio_text(row) +
            "</td></tr>\n";
  }
  return html + points + "</tbody></table></div>\n";
}

}  // namespace

std::string cameras_section(const ReportData& data) {
  const std::vector<CameraRows>& cameras = data.ledger.cameras;
  if (cameras.empty()) return {};
  std::string html =
      "<section id=\"cameras\" aria-labelledby=\"cameras-title\">\n<h2 id=\"cameras-title\">Cameras</h2>\n";
  html += formatted(
      "<p>Every other section shows the worst of %zu cameras: for each value the greatest error, the "
      "greatest ratio and the greatest time, each from the camera where it is worst. A star marks the "
      "front of one camera; values without effect in a camera are left out of its table.</p>\n",
      cameras.size());
  if (!data.ledger.points.empty())
    html +=
        "<p>A combination has the time of the camera where its frames take longest, and the greatest error. Its "
        "pictures are of one camera: the one where the user's settings are least right. At the end of each table "
        "stand the combinations of the front.</p>\n";
  for (std::size_t i = 0; i < cameras.size(); ++i)
    html += "<details><summary>" + escaped(camera_name(cameras[i])) + "</summary>\n" +
            camera_table(cameras[i], points_rows(data.ledger.points, i)) + "</details>\n";
  return html + "</section>\n";
}

}  // namespace gloam
