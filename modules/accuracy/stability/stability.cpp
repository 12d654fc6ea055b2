// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/core/text/formatted.h"
#include "engine/core/text/plain_text.h"
#include "modules/accuracy/report/html_text.h"

namespace gloam {
namespace {

std::string_view kind_name(StabilityKind kind) {
  switch (kind) {
    case StabilityKind::kernel:
      return "kernel";
    case StabilityKind::invariance:
      return "invariance";
    case StabilityKind::curve:
      return "curve";
  }
  return "kernel";
}

bool keeps_bound(const StabilityCheck& check, double error) { return std::isfinite(error) && error <= check.bound; }

/// null for what is not finite, which JSON cannot write.
nlohmann::ordered_json number_json(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json check_json(const StabilityCheck& check) {
  nlohmann::ordered_json json = {{"id", check.name},
                                 {"kind", kind_name(check.kind)},
                                 {"what", check.sentence},
                                 {"holds", holds(check)},
                                 {"worst", number_json(check.worst)},
                                 {"worst_case", check.worst_case},
                                 {"bound", check.bound},
                                 {"unit", check.unit},
                                 {"seconds", check.seconds}};
  if (!check.skipped.empty()) json["skipped"] = check.skipped;
  if (!check.fault.empty()) json["fault"] = check.fault;
  if (!holds(check)) json["advice"] = check.advice;
  json["points"] = nlohmann::ordered_json::array();
  for (const StabilityPoint& point : check.curve) json["points"].push_back({point.at, number_json(point.error)});
  if (check.kind != StabilityKind::curve) return json;
  json["axis"] = check.axis;
  if (check.promised) json["promised"] = {check.promised->low, check.promised->high};
  if (const auto range = range_within_bound(check)) json["within_bound"] = {range->low, range->high};
  return json;
}

double number_of(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// nlohmann::json would cast a number that is out of range without a defined result.
std::uint32_t size_of(const nlohmann::json& json) {
  const bool fits = json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xffffffffu;
  if (!fits) throw nlohmann::json::type_error::create(302, "a size is out of range", &json);
  return json.get<std::uint32_t>();
}

StabilityCheck check_of(const nlohmann::json& json) {
  StabilityCheck check = {.name = json.at("id"),
                          .sentence = json.at("what"),
                          .unit = json.at("unit"),
                          .bound = json.at("bound"),
                          .advice = json.value("advice", ""),
                          .axis = json.value("axis", ""),
                          .worst = number_of(json.at("worst")),
                          .worst_case = json.at("worst_case"),
                          .skipped = json.value("skipped", ""),
                          .fault = json.value("fault", ""),
                          .seconds = json.at("seconds")};
  const std::string kind = json.at("kind");
  for (const auto known : {StabilityKind::kernel, StabilityKind::invariance, StabilityKind::curve})
    if (kind == kind_name(known)) check.kind = known;
  if (json.contains("promised")) check.promised = {json["promised"].at(0), json["promised"].at(1)};
  for (const nlohmann::json& point : json.at("points"))
    check.curve.push_back({point.at(0).get<double>(), number_of(point.at(1))});
  return check;
}

}  // namespace

Result<StabilityReport> parse_stability_json(std::string_view text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    const nlohmann::json& device = json.at("device");
    StabilityReport report = {.gloam = json.at("gloam"),
                              .device = device.at("name"),
                              .driver = device.at("driver"),
                              .device_type = device.at("type"),
                              .subgroup_size = size_of(device.at("subgroup_size")),
                              .host = json.at("host"),
                              .quick = json.at("quick"),
                              .seconds = json.at("seconds")};
    for (const nlohmann::json& check : json.at("checks")) report.checks.push_back(check_of(check));
    return report;
  } catch (const nlohmann::json::exception& fault) {
    return Error{ErrorKind::input, "not the file of a self-test: " + one_line(fault.what(), 300)};
  }
}

bool holds(const StabilityCheck& check) {
  if (!check.skipped.empty()) return true;
  return check.fault.empty() && keeps_bound(check, check.worst);
}

std::optional<StabilityRange> range_within_bound(const StabilityCheck& check) {
  std::optional<StabilityRange> widest, run;
  std::size_t widest_points = 0, points = 0;
  for (const StabilityPoint& point : check.curve) {
    if (!keeps_bound(check, point.error)) {
      run.reset();
      points = 0;
      continue;
    }
    // The points of a file may descend.
    run = {std::min(run ? run->low : point.at, point.at), std::max(run ? run->high : point.at, point.at)};
    ++points;
    const bool overlaps = !check.promised || (run->low <= check.promised->high && run->high >= check.promised->low);
    if (!overlaps || points <= widest_points) continue;
    widest = run;
    widest_points = points;
  }
  return widest;
}

std::size_t failed_checks(const StabilityReport& report) {
  return static_cast<std::size_t>(
      std::ranges::count_if(report.checks, [](const StabilityCheck& check) { return !holds(check); }));
}

std::string stability_line(const StabilityCheck& check) {
  std::string line = check.name;
  line.resize(std::max<std::size_t>(line.size(), 28), ' ');
  if (!check.skipped.empty()) return line + " skipped: " + check.skipped + "\n";
  if (!check.fault.empty()) return line + " FAILED: " + check.fault + "\n";
  line += formatted(" %10s %s, bound %s", number_text(check.worst).c_str(), check.unit.c_str(),
                    number_text(check.bound).c_str());
  if (!check.worst_case.empty()) line += " (" + check.worst_case + ")";
  if (!holds(check)) return line + ": FAILED. " + check.advice + "\n";
  if (check.worst > 0.0 && check.bound > 0.0) line += formatted(": margin %.3g", check.bound / check.worst);
  if (const auto range = range_within_bound(check)) line += formatted(", holds %.3g to %.3g", range->low, range->high);
  return line + "\n";
}

std::string limits_table(std::span<const StabilityCheck> checks) {
  std::string text =
      "| check | what | by | from | to | error at most | if it is more |\n| --- | --- | --- | --- | --- | --- | --- "
      "|\n";
  for (const StabilityCheck& check : checks) {
    if (!check.promised) continue;
    text += "| `" + check.name + "` | " + check.sentence + " | " + check.axis +
            formatted(" | %.3g | %.3g | %g ", check.promised->low, check.promised->high, check.bound) + check.unit +
            " | " + check.advice + " |\n";
  }
  return text;
}

std::string stability_json(const StabilityReport& report) {
  nlohmann::ordered_json json = {{"version", 1},
                                 {"gloam", report.gloam},
                                 {"device",
                                  {{"name", report.device},
                                   {"driver", report.driver},
                                   {"type", report.device_type},
                                   {"subgroup_size", report.subgroup_size}}},
                                 {"host", report.host},
                                 {"quick", report.quick},
                                 {"seconds", report.seconds},
                                 {"failed", failed_checks(report)},
                                 {"checks", nlohmann::ordered_json::array()}};
  for (const StabilityCheck& check : report.checks) json["checks"].push_back(check_json(check));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace gloam
