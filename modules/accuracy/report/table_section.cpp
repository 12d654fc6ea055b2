// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

/// A cell and the number that it is sorted by; without one, by its text.
struct TableCell {
  std::string html;
  std::optional<double> number = {};
  bool numeric = false;
};

struct TableColumn {
  std::string title;
  bool numeric = false;
  TableCell (*cell)(const ReportData& data, const LedgerRow& row);
};

TableCell number_cell(const std::optional<double>& value) { return {value ? number_text(*value) : "–", value, true}; }

const LedgerRow* standard_of(const ReportData& data, const LedgerRow& row) {
  for (const KnobResults& knob : data.knobs)
    if (knob.name == row.knob) return knob.standard;
  return nullptr;
}

std::string mark_text(const LedgerRow& row) {
  if (!row.wrong.empty()) return "wrong: " + escaped(row.wrong);
  if (row.on_front) return "front";
  return row.no_effect && !row.is_default ? "no effect" : "";
}

TableCell flip_cell(const LedgerRow& row, double ErrorPair::*member) {
  if (!row.flip) return number_cell(std::nullopt);
  const double value = (*row.flip).*member;
  return {row.below_noise ? "&lt; noise" : number_text(value), value, true};
}

std::vector<TableColumn> table_columns(const Ledger& ledger) {
  std::vector<TableColumn> columns = {
      {"Knob", false,
       [](const ReportData&, const LedgerRow& row) { return TableCell{"<code>" + escaped(row.knob) + "</code>"}; }},
      {"Value", false,
       [](const ReportData& data, const LedgerRow& row) {
         return TableCell{look_link(row, standard_of(data, row), escaped(row.value)) +
                          (row.is_default ? " (default)" : "")};
       }},
      {"Mark", false, [](const ReportData&, const LedgerRow& row) { return TableCell{mark_text(row)}; }},
      {"Ratio", true,
       [](const ReportData&, const LedgerRow& row) {
         return TableCell{ratio_text(row), row.ratio, true};
       }},
      {"Frame, ms", true, [](const ReportData&, const LedgerRow& row) { return number_cell(row.ms.median_ms); }},
      {"FLIP mean", true, [](const ReportData&, const LedgerRow& row) { return flip_cell(row, &ErrorPair::mean); }},
      {"FLIP p99", true, [](const ReportData&, const LedgerRow& row) { return flip_cell(row, &ErrorPair::p99); }},
      {"FLIP at edges", true,
       [](const ReportData&, const LedgerRow& row) {
         return number_cell(row.edges ? std::optional(row.edges->flip.mean) : std::nullopt);
       }},
      {"RMSE, cd/m²", true, [](const ReportData&, const LedgerRow& row) { return number_cell(row.rmse); }}};
  if (std::ranges::any_of(ledger.rows, [](const LedgerRow& row) { return row.counted.has_value(); }))
    columns.push_back({"Counted", true, [](const ReportData&, const LedgerRow& row) {
                         return row.counted ? TableCell{number_text(row.counted->value) + " <span class=\"unit\">" +
                                                            escaped(row.counted->unit) + "</span>",
                                                        row.counted->value, true}
                                            : number_cell(std::nullopt);
                       }});
  if (std::ranges::any_of(ledger.rows, [](const LedgerRow& row) { return row.temporal.has_value(); }))
    columns.push_back({"Temporal", true, [](const ReportData&, const LedgerRow& row) {
                         return number_cell(row.temporal ? std::optional(row.temporal->mean) : std::nullopt);
                       }});
  if (std::ranges::any_of(ledger.rows, [](const LedgerRow& row) { return row.whole.has_value(); }))
    columns.push_back({"Whole frame, FLIP", true, [](const ReportData&, const LedgerRow& row) {
                         return number_cell(row.whole ? std::optional(row.whole->flip.mean) : std::nullopt);
                       }});
  if (std::ranges::any_of(ledger.rows, [](const LedgerRow& row) { return row.effect_model.has_value(); }))
    columns.push_back({"Effect’s model, FLIP", true, [](const ReportData&, const LedgerRow& row) {
                         return number_cell(row.effect_model ? std::optional(row.effect_model->flip.mean)
                                                             : std::nullopt);
                       }});
  columns.push_back(
      {"Module CPU, ms", true, [](const ReportData&, const LedgerRow& row) { return number_cell(row.module_cpu_ms); }});
  columns.push_back({"Module passes, ms", true,
                     [](const ReportData&, const LedgerRow& row) { return number_cell(row.module_gpu_ms); }});
  columns.push_back({"GPU memory, MiB", true, [](const ReportData&, const LedgerRow& row) {
                       return number_cell(static_cast<double>(row.gpu_bytes) / (1024.0 * 1024.0));
                     }});
  columns.push_back({"Pairs", true, [](const ReportData&, const LedgerRow& row) {
                       return TableCell{std::to_string(row.pairs), row.pairs, true};
                     }});
  return columns;
}

std::string table_row(const ReportData& data, const std::vector<TableColumn>& columns, const LedgerRow& row) {
  std::string html =
      formatted("<tr data-front=\"%d\" data-effect=\"%d\">", row.on_front ? 1 : 0, row.no_effect ? 0 : 1);
  for (const TableColumn& column : columns) {
    const TableCell cell = column.cell(data, row);
    const bool names_row = &column == &columns[1];  // the value; that of a knob's name would name several rows
    html += names_row ? "<th scope=\"row\"" : cell.numeric ? "<td class=\"number\"" : "<td";
    if (cell.number) html += formatted(" data-sort=\"%.9g\"", *cell.number);
    html += ">" + cell.html + (names_row ? "</th>" : "</td>");
  }
  return html + "</tr>\n";
}

std::string term(std::string_view name, std::string_view value) {
  return "<dt>" + std::string(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
}

/// The greatest noise of each reference.
std::string noise_list(const ReportData& data) {
  std::string list;
  for (const KnobResults& knob : data.knobs) {
    double noise = 0.0;
    for (const LedgerRow* row : knob.rows) noise = std::max(noise, row->reference_noise);
    if (noise > 0.0) list += "<li><code>" + escaped(knob.name) + "</code>: " + number_text(noise) + "</li>\n";
  }
  if (list.empty()) return "<p>No reference has noise: all are exact or computed in double precision.</p>\n";
  return "<p>References that sample have noise: the change of the picture from half to all of their samples (FLIP, or "
         "RMSE "
         "if the reference has no picture). Smaller errors are not told apart.</p>\n<ul>\n" +
         list + "</ul>\n";
}

}  // namespace

std::string table_section(const ReportData& data) {
  std::string html =
      "<section id=\"everything\" aria-labelledby=\"everything-title\">\n<h2 id=\"everything-title\">Everything</h2>\n"
      "<form class=\"filters\" role=\"search\"><p><label for=\"filter\">Filter by knob, value or mark</label> "
      "<input type=\"search\" id=\"filter\" autocomplete=\"off\"></p>\n"
      "<p><input type=\"checkbox\" id=\"front-only\"> <label for=\"front-only\">only the front</label></p>\n"
      "<p><input type=\"checkbox\" id=\"effect-only\"> <label for=\"effect-only\">hide rows without "
      "effect</label></p>\n"
      "<p id=\"shown\" role=\"status\"></p></form>\n";
  const std::vector<TableColumn> columns = table_columns(data.ledger);
  html +=
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"everything-title\">\n<table "
      "id=\"rows\"><thead><tr>";
  for (const TableColumn& column : columns)
    html += "<th scope=\"col\" aria-sort=\"none\"" + std::string(column.numeric ? " class=\"number\"" : "") +
            "><button type=\"button\">" + escaped(column.title) + "</button></th>";
  html += "</tr></thead><tbody>\n";
  for (const LedgerRow& row : data.ledger.rows) html += table_row(data, columns, row);
  html += "</tbody></table></div>\n";
  return html +
         "<p>Front: no other value of the knob is as cheap and as right. Ratio: time divided by the default’s, the "
         "median over "
         "pairs of neighbouring frames, with its 95 % interval. At edges: the mean over the pixels within two of an "
         "edge of the reference. Whole frame: against the frame with every knob at its "
         "most exact value. Effect’s model: against a picture that does not share the model. Module times are those of "
         "the knob’s module alone, on "
         "the "
         "wall.</p>\n</section>\n";
}

std::string conditions_section(const ReportData& data) {
  const LedgerHeader& header = data.ledger.header;
  std::string html =
      "<section id=\"conditions\" aria-labelledby=\"conditions-title\">\n<h2 "
      "id=\"conditions-title\">Conditions</h2>\n<dl>\n";
  html += term("Scene", header.scene + " (" + header.scene_hash + ")");
  html += term("Camera", header.camera.empty() ? "the first one" : header.camera);
  html += term("Scene time", formatted("%g s", header.time_s));
  html += term("Picture", formatted("%u × %u pixels", header.width, header.height));
  html +=
      term("Device", header.device + " (" + header.device_type + formatted(", subgroups of %u)", header.subgroup_size));
  html += term("Driver", header.driver);
  html += term("Clock", header.clock);
  html +=
      term("Frames", formatted("at most %u pairs a value", header.frames) +
                         (header.seconds > 0.0 ? formatted(", fewer to end in about %g minutes", header.seconds / 60.0)
                                               : std::string()));
  html += term("Reference samples", formatted("%u a pixel", header.samples));
  html += term("Program", "gloam " + header.version + " (" + header.build + ")");
  if (header.quick) html += term("Quick", "a small picture, few frames and samples: errors and times are noisier");
  html += "</dl>\n<h3>Noise</h3>\n" + noise_list(data);
  html +=
      "<h3>How to reproduce</h3>\n<pre tabindex=\"0\" role=\"region\" aria-label=\"Command line\"><code "
      "id=\"command\">" +
      escaped(data.command) + "</code></pre>\n";
  return html +
         "<p>The same numbers are in <a href=\"ledger.json\">ledger.json</a> and <a "
         "href=\"ledger.csv\">ledger.csv</a>" +
         (data.ledger.points.empty() ? "" : " (combinations: <a href=\"points.csv\">points.csv</a>)") +
         ".</p>\n</section>\n";
}

}  // namespace gloam
