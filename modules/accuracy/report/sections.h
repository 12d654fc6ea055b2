// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "modules/accuracy/report/report_data.h"

// Sections of the report, as HTML.

namespace gloam {

/// The best combination for each time and each error, the front, and how well the model predicted. Empty without
/// points.
[[nodiscard]] std::string budgets_section(const ReportData& data);
/// The recommended combination, its picture beside that of the user's settings.
[[nodiscard]] std::string recommendation(const ReportData& data);
/// Values that give back time at a small error.
[[nodiscard]] std::string savings_section(const ReportData& data);
/// A plot and a table for each knob; knobs without effect.
[[nodiscard]] std::string effects_section(const ReportData& data);
/// Two pictures under a slider, the error and its worst areas.
[[nodiscard]] std::string look_section(const ReportData& data);
/// Effects that take no part in the scene's frames, and why. Empty if all knobs were measured.
[[nodiscard]] std::string called_section(const ReportData& data);
/// What the other sections show of several cameras, and a table of each. Empty for one camera.
[[nodiscard]] std::string cameras_section(const ReportData& data);
/// The self-test of the ledger's device: how many checks hold, and the curves.
[[nodiscard]] std::string stable_section(const ReportData& data);
/// All rows.
[[nodiscard]] std::string table_section(const ReportData& data);
/// Device, clock, size, noise and command line.
[[nodiscard]] std::string conditions_section(const ReportData& data);

/// Error against time of a knob's values: an SVG with logarithmic axes. Empty if no row has an error.
[[nodiscard]] std::string error_plot(const KnobResults& knob);

/// A link that shows two pictures in the look section, opened by the row's picture. `before`: name of the other.
[[nodiscard]] std::string look_link(const LedgerRow& row, const LedgerRow* before, std::string_view content,
                                    std::string_view attributes = {});
/// An image that the page's script fills from the embedded pictures, in a link to the full picture; a text if there is
/// no picture.
[[nodiscard]] std::string picture_html(const ReportData& data, const std::string& name, std::string_view description);
/// "12.3 ms (12.0–12.9)"
[[nodiscard]] std::string point_time(const ReportData& data, const LedgerPoint& point);
/// A list of the settings against the declared defaults. with_meaning: with the knobs' sentences.
[[nodiscard]] std::string settings_list(const ReportData& data, const LedgerPoint& point, bool with_meaning);
/// The settings as a file for --config, to copy or to download, and a link that shows the point's picture beside that
/// of the user's settings. id: of the element with the file's text. title: names the settings.
[[nodiscard]] std::string settings_file(const ReportData& data, const LedgerPoint& point, const std::string& id,
                                        const std::string& title);
/// "knob=value"; of a point, its settings_text()
[[nodiscard]] std::string setting_of(const LedgerRow& row);

extern const std::string_view kPageStyle;       ///< CSS
extern const std::string_view kStabilityStyle;  ///< CSS of the curves
extern const std::string_view kPageScript;      ///< JavaScript

}  // namespace gloam
