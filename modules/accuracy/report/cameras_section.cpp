// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

std::string camera_name(const CameraRows& camera) {
  return (camera.camera.empty() ? std::string("The first camera") : "Camera " + camera.camera) +
         formatted(" at %g s", camera.time_s);
}

std::string camera_table(const CameraRows& camera) {
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
  return html + "</tbody></table></div>\n";
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
  for (const CameraRows& camera : cameras)
    html +=
        "<details><summary>" + escaped(camera_name(camera)) + "</summary>\n" + camera_table(camera) + "</details>\n";
  return html + "</section>\n";
}

}  // namespace gloam
