// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/sweep/scene_list.h"

#include <gtest/gtest.h>

#include <set>

namespace gloam {
namespace {

std::vector<ListEntry> entries(std::string_view text, const std::string& path = "lists/all.txt") {
  auto parsed = parse_scene_list(text, path);
  EXPECT_TRUE(parsed.ok()) << (parsed ? "" : parsed.error().message);
  return parsed ? *parsed : std::vector<ListEntry>();
}

TEST(SceneList, paths_are_relative_to_the_list) {
  const auto list = entries("a.gltf --config low.json\nbuiltin:plain --config=/etc/low.json\n/scenes/b.gltf");
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].scene, "lists/a.gltf");
  EXPECT_EQ(list[0].arguments, (std::vector<std::string>{"--config", "lists/low.json"}));
  EXPECT_EQ(list[1].scene, "builtin:plain");
  EXPECT_EQ(list[1].arguments, (std::vector<std::string>{"--config=/etc/low.json"}));
  EXPECT_EQ(list[2].scene, "/scenes/b.gltf");
  EXPECT_EQ(entries("a.gltf", "all.txt")[0].scene, "a.gltf");
}

TEST(SceneList, quotes_keep_blanks_and_comments_are_skipped) {
  const auto list = entries("\n# one\r\n  'my scene.gltf'\t--camera \"the \"gate#2 # no option\r\n\n");
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].line, 3u);
  EXPECT_EQ(list[0].scene, "lists/my scene.gltf");
  EXPECT_EQ(list[0].arguments, (std::vector<std::string>{"--camera", "the gate#2"}));
}

TEST(SceneList, names_of_folders_depend_on_the_line_alone) {
  const auto list = entries("a.gltf\nb/a.gltf\na.gltf --camera x\nbuiltin:plain\n../ü ä.glb");
  const auto other = entries("builtin:plain\na.gltf   --camera  x # the same", "elsewhere/list");
  EXPECT_EQ(other[0].name, list[3].name);
  EXPECT_EQ(other[1].name, list[2].name);
  std::set<std::string> names;
  for (const ListEntry& entry : list) {
    names.insert(entry.name);
    EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_"), std::string::npos) << entry.name;
  }
  EXPECT_EQ(names.size(), list.size());
}

TEST(SceneList, a_fault_names_its_line) {
  const auto fault = [](std::string_view text) {
    const auto parsed = parse_scene_list(text, "l");
    return parsed ? "none" : parsed.error().message;
  };
  EXPECT_EQ(fault(""), "l: no line names a scene");
  EXPECT_EQ(fault("a\n\n'b"), "l:3: a quote is not closed");
  EXPECT_EQ(fault("a\na # again"), "l:2: repeats line 1");
  EXPECT_EQ(fault("a\n--quick a"), "l:2: begins with --quick; a line is a scene, then its options");
  EXPECT_EQ(fault("a --shard 1/2"), "l:1: --shard is no option of one scene");
}

TEST(SceneList, every_entry_is_in_one_shard) {
  for (std::uint32_t count = 1; count <= 5; ++count)
    for (std::size_t index = 0; index < 17; ++index) {
      int shards = 0;
      for (std::uint32_t number = 1; number <= count; ++number) shards += in_shard({number, count}, index) ? 1 : 0;
      EXPECT_EQ(shards, 1) << index << " of " << count;
    }
  EXPECT_TRUE(in_shard({2, 3}, 1));
}

TEST(SceneList, faults_are_one_line_whatever_a_word_holds) {
  const auto entries = parse_scene_list("-\x01\x02 a.glb\n", "list.txt");
  ASSERT_FALSE(entries.ok());
  EXPECT_EQ(entries.error().message.find_first_of("\x01\x02"), std::string::npos) << entries.error().message;
}

}  // namespace
}  // namespace gloam
