// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "modules/module_list/module_list.h"

#include "engine/scene/key_registry.h"

// The table in docs/scene-keys.md must match the registry, line by line.

namespace gloam {
namespace {

std::string element_words(KeyElement element) {
  switch (element) {
    case KeyElement::node:
      return "node";
    case KeyElement::light_node:
      return "node with a light";
    case KeyElement::mesh_node:
      return "node with a mesh";
    case KeyElement::camera_node:
      return "node with a camera";
    case KeyElement::material:
      return "material";
    case KeyElement::scene:
      return "scene";
  }
  return "";
}

std::string number_words(double value) {
  char words[32];
  std::snprintf(words, sizeof(words), "%.10g", value);
  return words;
}

std::string range_words(const SceneKey& key) {
  constexpr double kFar = std::numeric_limits<double>::max();
  if (key.min <= -kFar && key.max >= kFar) return "";
  if (key.max >= kFar) return ", at least " + number_words(key.min);
  return ", " + number_words(key.min) + " to " + number_words(key.max);
}

std::string type_words(const SceneKey& key) {
  switch (key.type) {
    case KeyType::boolean:
      return "boolean";
    case KeyType::number:
      return "number" + range_words(key);
    case KeyType::integer:
      return "integer" + range_words(key);
    case KeyType::text:
      return "text";
    case KeyType::vec2:
      return "2 numbers" + range_words(key);
    case KeyType::vec3:
      return "3 numbers" + range_words(key);
    case KeyType::choice:
      break;
  }
  std::string words;
  for (const std::string& choice : key.choices) words += (words.empty() ? "" : ", ") + choice;
  return "one of " + words;
}

std::string table_of(const KeyRegistry& registry) {
  std::string table;
  for (const SceneKey& key : registry.keys()) {
    table += "| " + element_words(key.on) + " | `" + key.name + "` | " + type_words(key) + " | " + key.unit + " | " +
             key.default_text + " | " + key.meaning + " |\n";
  }
  return table;
}

TEST(SceneKeysPage, its_table_is_the_registry) {
  std::ifstream page(GLOAM_SOURCE_DIR "/docs/scene-keys.md");
  ASSERT_TRUE(page.is_open());
  std::string table, line;
  while (std::getline(page, line))
    if (line.find("| `gloam.") != std::string::npos) table += line + "\n";
  const ModuleList modules = make_all_modules();
  const std::string expected = table_of(make_key_registry(modules));
  EXPECT_TRUE(table == expected) << "the table of docs/scene-keys.md should be\n" << expected;
}

}  // namespace
}  // namespace gloam
