// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/knobs/knobs.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/core/assert.h"
#include "engine/core/text/json_nesting.h"
#include "engine/core/text/nearest_name.h"
#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

std::string number_text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  return std::string(buffer, end);
}

/// "shadows.filter=pcss or chs".
std::string with_or(std::string_view setting) {
  std::string text(setting);
  for (std::size_t bar = text.find('|'); bar != std::string::npos; bar = text.find('|')) text.replace(bar, 1, " or ");
  return text;
}

std::string valid_values(const Knob& knob) {
  if (knob.type != Knob::Type::choice) {
    const std::string kind = knob.type == Knob::Type::integer ? "an integer" : "a number";
    return kind + " in " + number_text(knob.min) + "…" + number_text(knob.max) +
           (knob.unit.empty() ? "" : " " + knob.unit);
  }
  std::string list = "one of ";
  for (std::size_t i = 0; i < knob.choices.size(); ++i) list += (i > 0 ? ", " : "") + knob.choices[i];
  return list;
}

/// The number that a text stands for; nullopt if it is not a value of the knob.
std::optional<double> parse_value(const Knob& knob, std::string_view value) {
  if (knob.type == Knob::Type::choice) {
    const auto found = std::find(knob.choices.begin(), knob.choices.end(), value);
    if (found == knob.choices.end()) return std::nullopt;
    return static_cast<double>(found - knob.choices.begin());
  }
  double parsed = 0.0;
  const auto result = std::from_chars(value.data(), value.data() + value.size(), parsed);
  if (result.ec != std::errc() || result.ptr != value.data() + value.size()) return std::nullopt;
  if (!(parsed >= knob.min && parsed <= knob.max)) return std::nullopt;
  if (knob.type == Knob::Type::integer && parsed != std::floor(parsed)) return std::nullopt;
  return parsed;
}

}  // namespace

std::string value_text(const Knob& knob, double value) {
  return knob.type == Knob::Type::choice ? knob.choices[static_cast<std::size_t>(value)] : number_text(value);
}

void KnobRegistry::add(Knob knob) {
  GLOAM_ASSERT(find(knob.name) == nullptr, "knob " + knob.name + " is declared twice");
  if (knob.type == Knob::Type::choice) {
    knob.min = 0.0;
    knob.max = static_cast<double>(knob.choices.size()) - 1.0;
  }
  GLOAM_ASSERT(knob.default_number >= knob.min && knob.default_number <= knob.max,
               "knob " + knob.name + ": its default lies outside its range");
  GLOAM_ASSERT(knob.exact.empty() || parse_value(knob, knob.exact),
               "knob " + knob.name + ": its exact value is none of its values");
  GLOAM_ASSERT(knob.taste.empty() || (knob.exact.empty() && !knob.same_picture),
               "knob " + knob.name + ": a taste has no exact value");
  values_.push_back(knob.default_number);
  knobs_.push_back(std::move(knob));
}

Status KnobRegistry::set(std::string_view name, std::string_view value) {
  const Knob* knob = find(name);
  if (knob == nullptr) {
    std::vector<std::string> names;
    for (const Knob& k : knobs_) names.push_back(k.name);
    return Error{ErrorKind::usage, "unknown knob " + one_line(name) + "; " + valid_names(name, names)};
  }
  const std::optional<double> parsed = parse_value(*knob, value);
  if (!parsed)
    return Error{ErrorKind::usage,
                 "knob " + knob->name + " must be " + valid_values(*knob) + ", is " + in_quotes(value)};
  values_[static_cast<std::size_t>(knob - knobs_.data())] = *parsed;
  ++version_;
  return {};
}

Status KnobRegistry::set_assignment(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos)
    return Error{ErrorKind::usage, "a knob is set as NAME=VALUE, not " + in_quotes(assignment)};
  return set(assignment.substr(0, equals), assignment.substr(equals + 1));
}

Status KnobRegistry::set_from_json(std::string_view text, std::string_view source) {
  if (nests_too_deep(text)) return Error{ErrorKind::usage, std::string(source) + ": " + too_deep_text()};
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::usage, std::string(source) + ": is not a JSON object of knobs"};
  for (const auto& [name, value] : json.items()) {
    const std::string word = value.is_string() ? value.get<std::string>() : value.dump();
    if (Status status = set(name, word); !status.ok())
      return Error{ErrorKind::usage, std::string(source) + ": " + status.error().message};
  }
  return {};
}

const Knob* KnobRegistry::find(std::string_view name) const {
  const auto found = std::find_if(knobs_.begin(), knobs_.end(), [&](const Knob& k) { return k.name == name; });
  return found == knobs_.end() ? nullptr : &*found;
}

std::size_t KnobRegistry::index_of(const Knob& knob) const {
  const std::less<const Knob*> before;
  const bool own = !before(&knob, knobs_.data()) && before(&knob, knobs_.data() + knobs_.size());
  GLOAM_ASSERT(own, "knob " + knob.name + " is read with a Knob of another registry");
  return static_cast<std::size_t>(&knob - knobs_.data());
}

std::size_t KnobRegistry::index_of(std::string_view name, Knob::Type type) const {
  const Knob* knob = find(name);
  GLOAM_ASSERT(knob != nullptr, "knob " + std::string(name) + " must be declared before it is read or set");
  GLOAM_ASSERT(knob->type == type, "knob " + std::string(name) + " is declared with another type");
  return static_cast<std::size_t>(knob - knobs_.data());
}

void KnobRegistry::store(std::string_view name, Knob::Type type, double value) {
  const std::size_t i = index_of(name, type);
  GLOAM_ASSERT(value >= knobs_[i].min && value <= knobs_[i].max,
               "knob " + std::string(name) + " must be " + valid_values(knobs_[i]));
  values_[i] = value;
  ++version_;
}

void KnobRegistry::set_number(const Knob& knob, double number) {
  const std::size_t i = index_of(knob);
  GLOAM_ASSERT(number >= knob.min && number <= knob.max, "a knob is set to one of its values");
  values_[i] = number;
  ++version_;
}

void KnobRegistry::take_values(const KnobRegistry& other) {
  GLOAM_ASSERT(values_.size() == other.values_.size(), "values are of a registry with the same knobs");
  std::ranges::copy(other.values_, values_.begin());
  version_ = other.version_;
}

std::string KnobRegistry::unmet_setting(const Knob& knob) const { return unmet_setting(knob, knobs_.size()); }

std::string KnobRegistry::unmet_setting(const Knob& knob, std::size_t depth) const {
  constexpr std::string_view kAnd = " and ";
  // Settings that need each other end.
  std::string_view left = depth > 0 ? std::string_view(knob.only_with) : std::string_view();
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(kAnd), left.size());
    const std::string_view setting = left.substr(0, end);
    left.remove_prefix(std::min(end + kAnd.size(), left.size()));
    const Knob* other = find(setting.substr(0, setting.find_first_of("=>")));
    if (other == nullptr) continue;  // a host leaves its module out
    if (!is_met(setting, *other)) return "only with " + with_or(setting) + ", which is " + text(*other);
    if (std::string unmet = unmet_setting(*other, depth - 1); !unmet.empty()) return unmet;
  }
  return {};
}

bool KnobRegistry::is_met(std::string_view setting, const Knob& knob) const {
  const std::size_t sign = setting.find_first_of("=>");
  const std::string_view wanted = setting.substr(sign + 1);
  if (setting[sign] == '=') return ("|" + std::string(wanted) + "|").find("|" + text(knob) + "|") != std::string::npos;
  double least = 0.0;
  std::from_chars(wanted.data(), wanted.data() + wanted.size(), least);
  return number(knob) > least;
}

double KnobRegistry::number(const Knob& knob) const { return values_[index_of(knob)]; }

std::string KnobRegistry::text(const Knob& knob) const { return value_text(knob, number(knob)); }

}  // namespace gloam
