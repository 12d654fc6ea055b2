// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
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

/// The point with the least error among those within a time; of equal ones, the fastest. Null: none is as fast.
const LedgerPoint* best_within(const Ledger& ledger, double budget_ms) {
  const LedgerPoint* best = nullptr;
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.ms.median_ms <= budget_ms &&
        (best == nullptr || point.measured.flip->mean < best->measured.flip->mean))
      best = &point;
  return best;
}

/// The fastest point of the front with an error below the bound.
const LedgerPoint* cheapest_below(const Ledger& ledger, double bound) {
  for (const LedgerPoint& point : ledger.points)
    if (point.measured.on_front && point.measured.flip->mean < bound) return &point;
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

std::string answer_card(const ReportData& data, const Answer& answer, const std::string& id) {
  const LedgerRow& row = answer.point->measured;
  std::string html = "<li class=\"card setting\">\n<h4>" + escaped(answer.question) + "</h4>\n<p>";
  html += row.is_default ? "<strong class=\"gain\">Your settings</strong>: " + ms_text(row.ms.median_ms)
                         : "<strong class=\"gain\">" + ratio_text(row) +
                               "</strong> of your time: " + point_time(data, *answer.point);
  html += ".</p>\n<p>" + escaped(sentence(error_words(row))) + ".</p>\n";
  if (answer.point == data.recommended) return html + "<p>The settings at the top of this page.</p>\n</li>\n";
  html += picture_html(data, row.picture, "The scene with " + setting_of(row));
  if (row.is_default) return html + "</li>\n";
  html += "<p>Against the defaults:</p>\n" + settings_list(data, *answer.point, false);
  html += settings_file(data, *answer.point, id, answer.question);
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

std::string point_row(const ReportData& data, const LedgerPoint& point) {
  const LedgerRow& row = point.measured;
  const LedgerRow* users = data.users == nullptr ? nullptr : &data.users->measured;
  return formatted("<tr data-ms=\"%.9g\" data-flip=\"%.9g\" data-now=\"%d\" data-config=\"", row.ms.median_ms,
                   row.flip->mean, row.is_default ? 1 : 0) +
         escaped(settings_config(point.settings)) + "\"><th scope=\"row\">" +
         look_link(row, users, "<code>" + escaped(setting_of(row)) + "</code>") + "</th><td class=\"number\">" +
         ratio_text(row) + "</td><td class=\"number\">" + ms_text(row.ms.median_ms) + "</td><td class=\"number\">" +
         ms_text(point.predicted_ms) + "</td><td class=\"number\">" + number_text(row.flip->mean) +
         "</td><td class=\"number\">" + number_text(point.predicted_flip) + "</td><td>" + point_notes(point) +
         "</td></tr>\n";
}

std::string points_list(const ReportData& data) {
  std::string html = "<details><summary>All measured combinations: " + std::to_string(data.ledger.points.size()) +
                     "</summary>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All measured "
                     "combinations\"><table id=\"points\"><thead><tr><th scope=\"col\">Setting</th>";
  for (const char* title : {"Ratio", "Time", "predicted", "Error", "predicted"})
    html += "<th scope=\"col\" class=\"number\">" + std::string(title) + "</th>";
  html += "<th scope=\"col\">Notes</th></tr></thead><tbody>\n";
  for (const LedgerPoint& point : data.ledger.points) html += point_row(data, point);
  return html + "</tbody></table></div></details>\n";
}

/// The script answers for the time that is typed here, from the table of all points.
std::string budget_choice(const Ledger& ledger) {
  const double fastest = ledger.points.front().measured.ms.median_ms;
  return formatted(
      "<p class=\"budget\" hidden><label for=\"budget\">Milliseconds that a frame may take</label> <input "
      "type=\"number\" id=\"budget\" min=\"0\" step=\"any\" value=\"%g\"></p>\n<p id=\"budget-answer\" "
      "role=\"status\"></p>\n",
      fastest <= 33.0 ? 33.0 : std::ceil(fastest));
}

std::string model_text(const Ledger& ledger) {
  if (!ledger.model || ledger.model->points == 0) return {};
  const ModelQuality& model = *ledger.model;
  const auto ratio = [](const ModelRatio& value) {
    return number_text(value.median) + " in the median, " + number_text(value.worst) + " at worst";
  };
  return "<p>How well the rows of single knobs predict combinations: measured time divided by predicted time is " +
         ratio(model.time) + "; for the error it is " + ratio(model.error) +
         formatted(" (%u combination%s).</p>\n", model.points, model.points == 1 ? "" : "s");
}

/// The plot of a knob, with the points as its values.
std::string front_plot(const ReportData& data) {
  KnobResults all = {.name = "whole settings"};
  if (data.users != nullptr) all.standard = &data.users->measured;
  for (const LedgerPoint& point : data.ledger.points) all.rows.push_back(&point.measured);
  return error_plot(all);
}

}  // namespace

std::string budgets_section(const ReportData& data) {
  const Ledger& ledger = data.ledger;
  if (ledger.points.empty()) return {};
  std::string html =
      "<section id=\"budgets\" aria-labelledby=\"budgets-title\">\n<h2 id=\"budgets-title\">What to turn down</h2>\n" +
      recommendation(data);
  html +=
      "<p class=\"keys\">The error is mean FLIP, 0 to 1, against the exact frame: the same techniques with every knob "
      "at "
      "its most exact value. Below 0.01 nobody sees it side by side, 0.03 is seen when flipping between the pictures, "
      "0.1 is seen at once. A small mean can hide bad places: p99 is the error that the worst hundredth of the pixels "
      "exceeds. <a href=\"#effects\">Each effect</a> has the errors against traced light.</p>\n";
  html += "<h3>For a time</h3>\n" + budget_choice(ledger) + unmet_budgets(ledger) +
          answer_cards(data, budget_answers(ledger), "budget");
  const std::vector<Answer> cheapest = error_answers(ledger);
  html += "<h3>The fastest below an error</h3>\n";
  html += cheapest.empty() ? "<p>No measured setting has an error below 0.03.</p>\n"
                           : answer_cards(data, cheapest, "error");
  html +=
      "<h3>The front</h3>\n<p class=\"keys\">Error against time of whole settings. A square surrounds your settings; "
      "a diamond is equal to the exact frame; blue points are on the front. A point shows its picture beside "
      "yours.</p>\n";
  html += "<div class=\"chart-and-table\">" + front_plot(data) + "</div>\n" + model_text(ledger) + points_list(data);
  return html + "</section>\n";
}

}  // namespace gloam
