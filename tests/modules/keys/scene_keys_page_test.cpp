// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

#include "engine/core/env.h"
#include "engine/scene/keys/registry.h"
#include "modules/module_list/module_list.h"

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

// With GLOAM_WRITE_PAGES set (target gloam_pages), the page gets the table.
TEST(SceneKeysPage, its_table_is_the_registry) {
  constexpr const char* kPage = GLOAM_SOURCE_DIR "/docs/scene-keys.md";
  std::ifstream page(kPage);
  ASSERT_TRUE(page.is_open());
  std::string before, table, after, line;
  while (std::getline(page, line)) {
    const bool row = line.find("| `gloam.") != std::string::npos;
    (row ? table : table.empty() ? before : after) += line + "\n";
  }
  page.close();
  const ModuleList modules = make_all_modules();
  const std::string expected = table_of(make_key_registry(modules));
  if (environment_text("GLOAM_WRITE_PAGES")) {
    std::ofstream(kPage) << before << expected << after;
    return;
  }
  EXPECT_TRUE(table == expected)
      << "`cmake --build build --target gloam_pages` writes the table of docs/scene-keys.md:\n"
      << expected;
}

}  // namespace
}  // namespace gloam
