// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/blade_types.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "engine/core/text/formatted.h"
#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

constexpr std::size_t kMaxPoints = 32;
constexpr float kFarthestPoint = 100.0f;
constexpr std::size_t kMaxFileBytes = 1u << 20;

std::string number_text(float value) { return formatted("%g", static_cast<double>(value)); }

/// A finite number that fills the whole text.
std::optional<float> number_of(std::string_view text) {
  float value = 0.0f;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kSpaces = " \t\r\v\f";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t begin = line.find_first_not_of(kSpaces); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpaces, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSpaces, end);
  }
  return words;
}

/// Range of one number of a line. Without `zero_allowed` the least value is excluded.
struct NumberField {
  const char* name;
  float greatest;
  bool zero_allowed;
  float BladeType::*target;
};
constexpr NumberField kFields[] = {{"share", 1e6f, false, &BladeType::share},
                                   {"length", 10.0f, false, &BladeType::length_scale},
                                   {"width", 10.0f, false, &BladeType::width_scale},
                                   {"stiffness", 1.0f, true, &BladeType::stiffness},
                                   {"taper", 1.0f, true, &BladeType::taper}};
constexpr std::size_t kFirstPoint = 1 + std::size(kFields);

/// The error without its place; empty if the number is good.
std::string read_number(const NumberField& field, std::string_view word, BladeType& type) {
  const std::optional<float> value = number_of(word);
  const bool good = value && *value <= field.greatest && (field.zero_allowed ? *value >= 0.0f : *value > 0.0f);
  if (good) {
    type.*field.target = *value;
    return {};
  }
  return std::string(field.name) + " must be " + (field.zero_allowed ? "0 to " : "above 0 and at most ") +
         number_text(field.greatest) + ", is " + in_quotes(word);
}

std::string read_point(std::string_view word, BladeType& type) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return "a point of the stem must be forward,up, is " + in_quotes(word);
  const std::optional<float> forward = number_of(word.substr(0, comma));
  const std::optional<float> up = number_of(word.substr(comma + 1));
  if (!forward || !up) return "a point of the stem must be two numbers, is " + in_quotes(word);
  if (std::abs(*forward) > kFarthestPoint || *up > kFarthestPoint)
    return "a point of the stem must lie within " + number_text(kFarthestPoint) + ", is " + in_quotes(word);
  if (*up < 0.0f) return "a point of the stem must not lie below 0, is " + in_quotes(word);
  if (type.points.empty() && (*forward != 0.0f || *up != 0.0f))
    return "the first point of the stem must be 0,0, is " + in_quotes(word);
  type.points.emplace_back(*forward, *up);
  return {};
}

/// Reads "damping=factor", which may stand before the points.
std::string read_damping(std::string_view word, BladeType& type) {
  constexpr NumberField kDamping{"damping", 100.0f, true, &BladeType::damping};
  return read_number(kDamping, word.substr(word.find('=') + 1), type);
}

std::string read_type(std::vector<std::string_view> words, BladeType& type) {
  if (words.size() > kFirstPoint && words[kFirstPoint].starts_with("damping=")) {
    std::string fault = read_damping(words[kFirstPoint], type);
    if (!fault.empty()) return fault;
    words.erase(words.begin() + kFirstPoint);
  }
  if (words.size() < kFirstPoint + 2)
    return "a type needs name, share, length, width, stiffness, taper and at least 2 points";
  if (words.size() > kFirstPoint + kMaxPoints)
    return "a stem has at most " + std::to_string(kMaxPoints) + " points, this one has " +
           std::to_string(words.size() - kFirstPoint);
  type.name = one_line(words[0]);
  for (std::size_t i = 0; i < std::size(kFields); ++i) {
    std::string fault = read_number(kFields[i], words[1 + i], type);
    if (!fault.empty()) return fault;
  }
  for (std::size_t i = kFirstPoint; i < words.size(); ++i) {
    std::string fault = read_point(words[i], type);
    if (!fault.empty()) return fault;
  }
  const auto reach = [](const vec2& p) { return std::max(std::abs(p.x), p.y); };
  if (std::ranges::none_of(type.points, [&](const vec2& p) { return reach(p) >= 1e-3f; }))
    return "the stem must be at least 0.001 long";
  return {};
}

}  // namespace

Result<std::vector<BladeType>> parse_blade_types(std::string_view text, std::string_view file) {
  std::vector<BladeType> types;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::vector<std::string_view> words = words_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (words.empty()) continue;
    BladeType type;
    std::string fault = read_type(words, type);
    if (fault.empty() && types.size() == GLOAM_GRASS_TYPES)
      fault = "a file has at most " + std::to_string(GLOAM_GRASS_TYPES) + " types";
    if (fault.empty() && std::ranges::any_of(types, [&](const BladeType& t) { return t.name == type.name; }))
      fault = "the type " + in_quotes(type.name) + " is there twice";
    if (!fault.empty())
      return Error{ErrorKind::input, one_line(file, 400) + " line " + std::to_string(line) + ": " + fault};
    types.push_back(std::move(type));
  }
  if (types.empty()) return Error{ErrorKind::input, one_line(file, 400) + ": has no blade type"};
  return types;
}

Result<std::vector<BladeType>> read_blade_types(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorKind::input, one_line(path, 400) + ": cannot be read"};
  std::string text(kMaxFileBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return Error{ErrorKind::input, one_line(path, 400) + ": cannot be read"};
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxFileBytes)
    return Error{ErrorKind::input, one_line(path, 400) + ": is longer than 1 MiB, too long for blade types"};
  return parse_blade_types(text, path);
}

}  // namespace gloam
