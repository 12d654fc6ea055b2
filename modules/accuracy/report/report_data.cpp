// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/report/report_data.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "modules/accuracy/report/html_text.h"

namespace gloam {
namespace {

std::vector<KnobResults> group_by_knob(const Ledger& ledger, const ReportRequest& request) {
  std::vector<KnobResults> knobs;
  for (const LedgerRow& row : ledger.rows) {
    if (knobs.empty() || knobs.back().name != row.knob) {
      KnobResults& knob = knobs.emplace_back();
      knob.name = row.knob;
      const auto meaning = std::ranges::find(request.meanings, row.knob, &KnobMeaning::knob);
      if (meaning != request.meanings.end()) knob.meaning = meaning->meaning;
    }
    knobs.back().rows.push_back(&row);
    if (row.is_default) knobs.back().standard = &row;
  }
  for (KnobResults& knob : knobs)
    knob.no_effect = knob.rows.size() > 1 && std::ranges::all_of(knob.rows, &LedgerRow::no_effect);
  return knobs;
}

/// Right, and significantly cheaper than the default.
bool saves(const LedgerRow& row) {
  return !row.is_default && row.wrong.empty() && !row.no_effect && row.ratio_high < 1.0 && row.flip;
}

const LedgerPoint* users_point(const Ledger& ledger) {
  const auto found =
      std::ranges::find_if(ledger.points, [](const LedgerPoint& point) { return point.measured.is_default; });
  return found == ledger.points.end() ? nullptr : &*found;
}

/// Only of the front: another point may be as fast and more right than a point that chance made the fastest.
const LedgerPoint* recommended_point(const Ledger& ledger, const LedgerPoint* users) {
  for (const double bound : {0.01, 0.03})
    for (const LedgerPoint& point : ledger.points) {
      const bool right =
          point.measured.flip->mean < bound || (users && point.measured.flip->mean <= users->measured.flip->mean);
      if (right && point.measured.on_front && point.measured.ratio_high < 1.0) return &point;
    }
  return nullptr;
}

bool in_list(const std::vector<Saving>& list, const LedgerRow* row) {
  return std::ranges::find(list, row, &Saving::row) != list.end();
}

/// The cheapest value of each knob that `accepts` takes.
std::vector<Saving> cheapest_of(const std::vector<KnobResults>& knobs,
                                const std::function<bool(const LedgerRow& row, const LedgerRow& standard)>& accepts) {
  std::vector<Saving> list;
  for (const KnobResults& knob : knobs) {
    if (knob.standard == nullptr) continue;
    const LedgerRow* best = nullptr;
    for (const LedgerRow* row : knob.rows)
      if (saves(*row) && accepts(*row, *knob.standard) && (best == nullptr || row->ratio < best->ratio)) best = row;
    if (best != nullptr) list.push_back({best, knob.standard});
  }
  std::ranges::stable_sort(list, {}, [](const Saving& saving) { return saving.row->ratio; });
  return list;
}

Savings find_savings(const std::vector<KnobResults>& knobs) {
  Savings savings;
  savings.no_less_right = cheapest_of(knobs, [](const LedgerRow& row, const LedgerRow& standard) {
    return standard.flip && *flip_error(row) <= *flip_error(standard);
  });
  savings.below_001 =
      cheapest_of(knobs, [](const LedgerRow& row, const LedgerRow&) { return *flip_error(row) < 0.01; });
  savings.below_003 =
      cheapest_of(knobs, [](const LedgerRow& row, const LedgerRow&) { return *flip_error(row) < 0.03; });
  std::erase_if(savings.below_003, [&](const Saving& saving) {
    return in_list(savings.below_001, saving.row) || in_list(savings.no_less_right, saving.row);
  });
  std::erase_if(savings.below_001, [&](const Saving& saving) { return in_list(savings.no_less_right, saving.row); });
  return savings;
}

/// Names of pictures, the most important first.
std::vector<std::string> names_by_importance(const ReportData& data) {
  std::vector<std::string> names;
  for (const KnobResults& knob : data.knobs)
    if (knob.standard != nullptr) names.push_back(knob.standard->picture);
  for (const LedgerPoint& point : data.ledger.points)
    if (point.measured.on_front || point.measured.is_default || point.is_exact) names.push_back(point.measured.picture);
  for (const auto* list : {&data.savings.no_less_right, &data.savings.below_001, &data.savings.below_003})
    for (const Saving& saving : *list) names.push_back(saving.row->picture);
  for (const LedgerRow& row : data.ledger.rows) names.push_back(row.picture);
  for (const LedgerPoint& point : data.ledger.points)
    for (const std::string& name : {point.measured.reference_picture, point.measured.picture,
                                    point.measured.worst_areas(), point.measured.heat_map()})
      names.push_back(name);
  for (const LedgerRow& row : data.ledger.rows) names.push_back(row.reference_picture);
  for (const LedgerRow& row : data.ledger.rows) names.push_back(row.worst_areas());
  for (const LedgerRow& row : data.ledger.rows) names.push_back(row.heat_map());
  return names;
}

void find_pictures(const ReportRequest& request, ReportData& data) {
  if (!request.picture) return;
  std::set<std::string> done = {""};
  for (const std::string& name : names_by_importance(data)) {
    if (!done.insert(name).second) continue;
    const std::optional<std::string> bytes = request.picture(name);
    if (!bytes) continue;
    data.linked.push_back(name);
    const std::string type = bytes->starts_with("\x89PNG") ? "image/png" : "image/jpeg";
    data.pictures.emplace_back(name, "data:" + type + ";base64," + base64(*bytes));
  }
  std::ranges::sort(data.linked);
}

}  // namespace

bool ReportData::has_picture(std::string_view name) const {
  return std::ranges::binary_search(linked, name, std::less<>());
}

ReportData report_data(const Ledger& ledger, const ReportRequest& request) {
  ReportData data = {.ledger = ledger, .command = request.command, .meanings = request.meanings};
  data.stability = request.stability;
  data.knobs = group_by_knob(ledger, request);
  data.savings = find_savings(data.knobs);
  data.users = users_point(ledger);
  data.recommended = recommended_point(ledger, data.users);
  find_pictures(request, data);
  return data;
}

}  // namespace gloam
