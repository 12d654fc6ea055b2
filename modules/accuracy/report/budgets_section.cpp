// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/text/formatted.h"
#include "modules/accuracy/report/html_text.h"
#include "modules/accuracy/report/sections.h"

namespace gloam {
namespace {

constexpr std::array kBudgetsMs = {8.0, 16.0, 33.0, 50.0, 100.0};
constexpr std::array kErrorBounds = {0.01, 0.03};

/// A question and the point that answers it.
struct Answer {
  std::string question;
  const LedgerPoint* point = nullptr;
};

double users_ms(const Ledger& ledger) {
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.is_default) return point.measured.ms.median_ms;
  return 0.0;
}

/// "12.3 ms (12.0–12.9)"
std::string point_time(const Ledger& ledger, const LedgerPoint& point) {
  const LedgerRow& row = point.measured;
  if (row.is_default) return ms_text(row.ms.median_ms);
  const double users = users_ms(ledger);
  return ms_text(row.ms.median_ms) + " (" + number_text(users * row.ratio_low) + "–" +
         number_text(users * row.ratio_high) + ")";
}

/// The point with the least error among those within a time; of equal ones, the fastest. Null: none is as fast.
const LedgerPoint* best_within(const Ledger& ledger, double budget_ms) {
  const LedgerPoint* best = nullptr;
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.ms.median_ms <= budget_ms &&
        (best == nullptr || point.measured.flip->mean < best->measured.flip->mean))
      best = &point;
  return best;
}

/// The fastest point with an error below the bound.
const LedgerPoint* cheapest_below(const Ledger& ledger, double bound) {
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.flip->mean < bound) return &point;
  return nullptr;
}

/// One answer for all budgets with the same best point.
std::vector<Answer> budget_answers(const Ledger& ledger) {
  std::vector<Answer> answers;
  for (const double budget : kBudgetsMs) {
    const LedgerPoint* point = best_within(ledger, budget);
    if (point == nullptr) continue;
    if (!answers.empty() && answers.back().point == point)
      answers.back().question += formatted(", %g ms", budget);
    else
      answers.push_back({formatted("Within %g ms", budget), point});
  }
  return answers;
}

std::vector<Answer> error_answers(const Ledger& ledger) {
  std::vector<Answer> answers;
  for (const double bound : kErrorBounds) {
    const LedgerPoint* point = cheapest_below(ledger, bound);
    if (point == nullptr) continue;
    if (!answers.empty() && answers.back().point == point)
      answers.back().question += formatted(", %g", bound);
    else
      answers.push_back({formatted("Error below %g", bound), point});
  }
  return answers;
}

/// "No measured setting is as fast as 8 ms or 16 ms: …"; empty if all budgets are met.
std::string unmet_budgets(const Ledger& ledger) {
  std::string list;
  for (const double budget : kBudgetsMs)
    if (best_within(ledger, budget) == nullptr) list += formatted("%s%g ms", list.empty() ? "" : " or ", budget);
  if (list.empty()) return {};
  return "<p>No measured setting is as fast as " + list + ": the fastest takes " +
         ms_text(ledger.points.front().measured.ms.median_ms) + ".</p>\n";
}

/// The settings against the declared defaults.
std::string settings_list(const ReportData& data, const LedgerPoint& point) {
  if (point.settings.empty()) return "<p>Nothing: all knobs are at their defaults.</p>\n";
  std::string html = "<ul>\n";
  for (const KnobValue& setting : point.settings) {
    const auto known = std::ranges::find(data.meanings, setting.knob, &KnobMeaning::knob);
    const bool has_default = known != data.meanings.end() && !known->default_value.empty();
    const std::string from = has_default ? known->default_value + " → " : std::string();
    html += "<li><code>" + escaped(setting.knob) + "</code> " + escaped(from) + "<strong>" + escaped(setting.value) +
            "</strong></li>\n";
  }
  return html + "</ul>\n";
}

/// Percent-encoded, for a data: URI.
std::string uri_text(std::string_view text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::string encoded;
  for (const char c : text)
    encoded += kPlain.find(c) != std::string_view::npos ? std::string(1, c)
                                                        : formatted("%%%02X", static_cast<unsigned char>(c));
  return encoded;
}

std::string config_html(const LedgerPoint& point, const std::string& id) {
  const std::string config = settings_config(point.settings);
  return "<pre tabindex=\"0\" role=\"region\" aria-label=\"Settings as a file for --config\"><code id=\"" + id + "\">" +
         escaped(config) + "</code></pre>\n<p class=\"do\"><button type=\"button\" data-copy=\"" + id +
         "\">Copy</button> <a href=\"data:application/json," + uri_text(config) + "\" download=\"" + id +
         ".json\">Download for <code>--config</code></a></p>\n";
}

const LedgerRow* users_row_of(const Ledger& ledger) {
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.is_default) return &point.measured;
  return nullptr;
}

std::string answer_card(const ReportData& data, const Answer& answer, const std::string& id) {
  const LedgerRow& row = answer.point->measured;
  std::string html = "<li class=\"card setting\">\n<h4>" + escaped(answer.question) +
                     "</h4>\n<p><strong class=\"gain\">" + point_time(data.ledger, *answer.point) + "</strong>";
  html += row.is_default ? std::string(": your own settings") : ", " + ratio_text(row) + " of your settings’ time";
  html += ".</p>\n<p>Error " + escaped(error_text_of(row)) + ".</p>\n";
  html += picture_html(data, row.picture, "The scene with " + setting_of(row));
  html += "<p>Against the defaults:</p>\n" + settings_list(data, *answer.point) + config_html(*answer.point, id);
  html += "<p>" + look_link(row, users_row_of(data.ledger), "Compare with your settings under a slider") + "</p>\n";
  return html + "</li>\n";
}

std::string answer_cards(const ReportData& data, const std::vector<Answer>& answers, const std::string& name) {
  std::string html = "<ul class=\"cards\">\n";
  for (std::size_t i = 0; i < answers.size(); ++i)
    html += answer_card(data, answers[i], name + "-" + std::to_string(i + 1));
  return html + "</ul>\n";
}

std::string point_notes(const LedgerPoint& point) {
  std::string notes = point.measured.is_default ? "default" : "";
  if (point.is_exact) notes += notes.empty() ? "exact" : ", exact";
  if (point.measured.on_front) notes += notes.empty() ? "on the front" : ", on the front";
  return notes;
}

std::string points_list(const ReportData& data) {
  std::string html =
      "<details><summary>All measured combinations: " + std::to_string(data.ledger.points.size()) +
      "</summary>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All measured "
      "combinations\"><table "
      "class=\"points\"><thead><tr><th scope=\"col\">Setting</th><th scope=\"col\" class=\"number\">Time</th><th "
      "scope=\"col\" class=\"number\">predicted</th><th scope=\"col\" class=\"number\">Error</th><th scope=\"col\" "
      "class=\"number\">predicted</th><th scope=\"col\">Notes</th></tr></thead><tbody>\n";
  for (const LedgerPoint& point : data.ledger.points) {
    const LedgerRow& row = point.measured;
    html += "<tr><th scope=\"row\">" +
            look_link(row, users_row_of(data.ledger), "<code>" + escaped(setting_of(row)) + "</code>") +
            "</th><td class=\"number\">" + point_time(data.ledger, point) + "</td><td class=\"number\">" +
            ms_text(point.predicted_ms) + "</td><td class=\"number\">" + number_text(row.flip->mean) +
            "</td><td class=\"number\">" + number_text(point.predicted_flip) + "</td><td>" + point_notes(point) +
            "</td></tr>\n";
  }
  return html + "</tbody></table></div></details>\n";
}

std::string model_text(const Ledger& ledger) {
  if (!ledger.model || ledger.model->points == 0) return {};
  const ModelQuality& model = *ledger.model;
  const auto ratio = [](const ModelRatio& value) {
    return number_text(value.median) + " in the median, " + number_text(value.worst) + " at worst";
  };
  return "<p>How well the rows of single knobs predict combinations: measured time divided by predicted time is " +
         ratio(model.time) + "; for the error it is " + ratio(model.error) +
         formatted(" (%u combinations).</p>\n", model.points);
}

/// The plot of a knob, with the points as its values.
std::string front_plot(const Ledger& ledger) {
  KnobResults all = {.name = "whole settings", .standard = users_row_of(ledger)};
  for (const LedgerPoint& point : ledger.points) all.rows.push_back(&point.measured);
  return error_plot(all);
}

}  // namespace

std::string budgets_section(const ReportData& data) {
  const Ledger& ledger = data.ledger;
  if (ledger.points.empty()) return {};
  std::string html =
      "<section id=\"budgets\" aria-labelledby=\"budgets-title\">\n<h2 id=\"budgets-title\">What to turn down</h2>\n"
      "<p>The best of the measured combinations for each time. Errors are mean FLIP against the whole frame with every "
      "knob at its most exact value: below 0.01 nobody sees it side by side, 0.03 is seen when flipping between the "
      "pictures, 0.1 is seen at once.</p>\n";
  html += unmet_budgets(ledger) + answer_cards(data, budget_answers(ledger), "budget");
  const std::vector<Answer> cheapest = error_answers(ledger);
  html += "<h3>The cheapest setting below an error</h3>\n";
  html += cheapest.empty() ? "<p>No measured setting has an error below 0.03.</p>\n"
                           : answer_cards(data, cheapest, "error");
  html +=
      "<h3>The front</h3>\n<p class=\"keys\">Error against time of whole settings. A square surrounds the default; "
      "a diamond is equal to the exact frame; blue points are on the front. A point shows its picture beside the "
      "default’s.</p>\n";
  html += "<div class=\"chart-and-table\">" + front_plot(ledger) + "</div>\n" + model_text(ledger) + points_list(data);
  return html + "</section>\n";
}

}  // namespace gloam
