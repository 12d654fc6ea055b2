// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/keys/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "engine/core/assert.h"
#include "engine/core/text/formatted.h"
#include "engine/core/text/nearest_name.h"
#include "engine/core/text/plain_text.h"

namespace gloam {
namespace {

constexpr double kNoMin = -std::numeric_limits<double>::max();
constexpr double kNoMax = std::numeric_limits<double>::max();
constexpr double kLargestInteger = 9007199254740992.0;  // 2^53: beyond it a double no longer tells integers apart

std::string number_text(double value) { return formatted("%.9g", value); }

/// Text of the key's range: " ≥ 0 m", " in 0…1", "" (any value).
std::string range_text(const SceneKey& key) {
  std::string text;
  if (key.min != kNoMin && key.max != kNoMax)
    text = "in " + number_text(key.min) + "…" + number_text(key.max);
  else if (key.min != kNoMin)
    text = "≥ " + number_text(key.min);
  else if (key.max != kNoMax)
    text = "≤ " + number_text(key.max);
  if (!key.unit.empty()) text += (text.empty() ? "in " : " ") + key.unit;
  return text.empty() ? text : " " + text;
}

std::string value_text(const SceneValue& value) {
  switch (value.kind) {
    case SceneValue::Kind::null:
      return "null";
    case SceneValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case SceneValue::Kind::number:
      return number_text(value.number);
    case SceneValue::Kind::text:
      return in_quotes(value.text);
    case SceneValue::Kind::object:
      return "an object";
    case SceneValue::Kind::array:
      break;
  }
  if (value.items.size() > 4) return "an array of " + std::to_string(value.items.size());
  std::string text = "[";
  for (const SceneValue& item : value.items) {
    if (text.size() > 1) text += ", ";
    text += item.kind == SceneValue::Kind::array ? "an array" : value_text(item);
  }
  return text + "]";
}

std::string wanted_text(const SceneKey& key) {
  switch (key.type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::number:
      return "a number" + range_text(key);
    case KeyType::integer:
      return "an integer" + range_text(key);
    case KeyType::text:
      return "a string";
    case KeyType::vec2:
      return "2 numbers" + range_text(key);
    case KeyType::vec3:
      return "3 numbers" + range_text(key);
    case KeyType::choice:
      break;
  }
  std::string text;
  for (std::size_t i = 0; i < key.choices.size(); ++i) {
    if (i > 0) text += i + 1 == key.choices.size() ? " or " : ", ";
    text += "\"" + key.choices[i] + "\"";
  }
  return text;
}

Error refuse(const SceneKey& key, const SceneValue& value) {
  return {ErrorKind::input, "must be " + wanted_text(key) + ", is " + value_text(value)};
}

bool in_range(const SceneKey& key, const SceneValue& value) {
  return value.kind == SceneValue::Kind::number && value.number >= key.min && value.number <= key.max;
}

bool all_in_range(const SceneKey& key, const SceneValue& value, std::size_t count) {
  if (value.kind != SceneValue::Kind::array || value.items.size() != count) return false;
  return std::all_of(value.items.begin(), value.items.end(), [&](const SceneValue& item) {
    return in_range(key, item) && std::fabs(item.number) <= static_cast<double>(std::numeric_limits<float>::max());
  });
}

}  // namespace

void KeyRegistry::add(SceneKey key) {
  GLOAM_ASSERT(find(key.name) == nullptr, "a scene key is registered once: " + key.name);
  GLOAM_ASSERT(key.type != KeyType::choice || !key.choices.empty(), "a choice needs its words: " + key.name);
  keys_.push_back(std::move(key));
}

void KeyRegistry::add_extension(SceneExtension extension) {
  GLOAM_ASSERT(std::none_of(extensions_.begin(), extensions_.end(),
                            [&](const SceneExtension& other) { return other.name == extension.name; }),
               "a glTF extension is registered once: " + extension.name);
  extensions_.push_back(std::move(extension));
}

void KeyRegistry::add_finish(std::string module, std::function<Status(World&)> finish) {
  finishers_.emplace_back(std::move(module), std::move(finish));
}

void KeyRegistry::set_light_test(std::function<bool(const World&, Entity)> is_light) {
  is_light_ = std::move(is_light);
}

const SceneKey* KeyRegistry::find(std::string_view name) const {
  for (const SceneKey& key : keys_)
    if (key.name == name) return &key;
  return nullptr;
}

Status KeyRegistry::finish(World& world) const {
  for (const auto& [module, finish] : finishers_) GLOAM_TRY(finish(world));
  return {};
}

Result<KeyValue> KeyRegistry::convert(const SceneKey& key, const SceneValue& value) {
  using Kind = SceneValue::Kind;
  switch (key.type) {
    case KeyType::boolean:
      if (value.kind == Kind::boolean) return KeyValue(value.boolean);
      if (value.kind == Kind::number && (value.number == 0.0 || value.number == 1.0))
        return KeyValue(value.number == 1.0);
      break;
    case KeyType::number:
      if (in_range(key, value)) return KeyValue(value.number);
      break;
    case KeyType::integer:
      if (in_range(key, value) && value.number == std::floor(value.number) &&
          std::fabs(value.number) <= kLargestInteger)
        return KeyValue(static_cast<long long>(value.number));
      break;
    case KeyType::text:
      if (value.kind == Kind::text) return KeyValue(value.text);
      break;
    case KeyType::choice:
      if (value.kind == Kind::text &&
          std::find(key.choices.begin(), key.choices.end(), value.text) != key.choices.end())
        return KeyValue(value.text);
      break;
    case KeyType::vec2:
      if (all_in_range(key, value, 2)) return KeyValue(vec2(value.items[0].number, value.items[1].number));
      break;
    case KeyType::vec3:
      if (all_in_range(key, value, 3))
        return KeyValue(vec3(value.items[0].number, value.items[1].number, value.items[2].number));
      break;
  }
  return refuse(key, value);
}

std::string KeyRegistry::nearest(std::string_view name) const {
  std::vector<std::string> names;
  for (const SceneKey& key : keys_) names.push_back(key.name);
  return std::string(nearest_name(name, names));
}

}  // namespace gloam
