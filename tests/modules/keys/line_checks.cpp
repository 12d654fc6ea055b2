// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/keys/line_checks.h"

#include <gmock/gmock.h>

#include <set>
#include <sstream>
#include <string>

namespace gloam::test {
namespace {

using Kind = SceneValue::Kind;

void expect_description(const SceneKey& key, const Line& line) {
  EXPECT_EQ(key.on, line.on);
  EXPECT_EQ(key.module, line.module);
  EXPECT_EQ(key.type, line.type);
  EXPECT_EQ(key.unit, line.unit);
  EXPECT_EQ(key.default_text, line.default_text);
  EXPECT_FALSE(key.meaning.empty());
  EXPECT_TRUE(key.set != nullptr);
  EXPECT_LT(key.min, key.max);
}

void expect_stored(const ModuleList& modules, const SceneKey& key, const Line& line) {
  Place place(modules, line.light);
  const Status status = set_key(key, line.good, place.target);
  ASSERT_TRUE(status.ok()) << status.error().message;
  line.look(place, true);
}

void expect_refused(const ModuleList& modules, const SceneKey& key, const Line& line) {
  Place place(modules, line.light);
  std::vector<SceneValue> bad = line.bad;
  bad.push_back({});
  bad.push_back({.kind = Kind::object});
  bad.push_back({.kind = Kind::array});
  for (const SceneValue& value : bad) {
    const Status status = set_key(key, value, place.target);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::input);
    EXPECT_THAT(status.error().message, ::testing::StartsWith("must be "));
  }
}

void expect_default(const ModuleList& modules, const SceneKey& key, const Line& line) {
  const std::string words = line.default_text;
  if (words.empty() || words == "automatic" || words.starts_with("from ")) return;
  Place place(modules, line.light);
  const Status status = set_key(key, parsed_value(words), place.target);
  ASSERT_TRUE(status.ok()) << status.error().message;
  line.look(place, false);
}

}  // namespace

Status set_key(const SceneKey& key, const SceneValue& value, KeyTarget& target) {
  const auto converted = KeyRegistry::convert(key, value);
  return converted.ok() ? key.set(target, *converted) : Status(converted.error());
}

SceneValue parsed_value(const std::string& words) {
  if (words == "true" || words == "false") return yes_or_no(words == "true");
  if (words.front() == '[') {
    SceneValue array{.kind = Kind::array};
    std::istringstream in(words.substr(1));
    double value = 0.0;
    for (char separator = ','; separator == ',' && in >> value; in >> separator) array.items.push_back(number(value));
    return array;
  }
  std::istringstream in(words);
  double value = 0.0;
  return in >> value ? number(value) : text(words);
}

void expect_key_lines(std::string_view module, const std::vector<Line>& lines) {
  const ModuleList modules = make_all_modules();
  const KeyRegistry registry = make_key_registry(modules);
  std::set<std::string> stated, actual;
  for (const Line& line : lines) EXPECT_TRUE(stated.insert(line.name).second) << line.name;
  for (const SceneKey& key : registry.keys())
    if (key.module == module) {
      EXPECT_TRUE(actual.insert(key.name).second) << key.name;
    }
  EXPECT_EQ(actual, stated);
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name);
    const SceneKey* key = registry.find(line.name);
    if (key == nullptr) continue;
    expect_description(*key, line);
    expect_stored(modules, *key, line);
    expect_refused(modules, *key, line);
    expect_default(modules, *key, line);
  }
}

}  // namespace gloam::test
