// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/settings.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(PlaySettingsTest, are_read_as_they_were_written) {
  const PlaySettings settings = {.width = 800, .height = 600, .scale = 0.42, .panel = true};
  const auto read = read_settings(settings_text(settings));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, settings);
  EXPECT_EQ(*read_settings(settings_text(PlaySettings())), PlaySettings());
}

TEST(PlaySettingsTest, wrong_values_keep_their_defaults) {
  const auto read = read_settings(R"({"width": 800, "height": 3, "scale": 7, "panel": "yes", "other": []})");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, PlaySettings());
  for (const char* wrong : {"", "[]", "{", "3"}) EXPECT_FALSE(read_settings(wrong).ok()) << wrong;
}

TEST(PlaySettingsTest, a_file_that_does_not_exist_means_the_defaults) {
  EXPECT_EQ(load_play_settings("no/such/file.json", null_log()), PlaySettings());
  EXPECT_EQ(load_play_settings("", null_log()), PlaySettings());
}

}  // namespace
}  // namespace gloam
