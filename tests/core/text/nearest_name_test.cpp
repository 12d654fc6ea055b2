// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/text/nearest_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gloam {
namespace {

const std::vector<std::string> kKnobs = {"lights.culling", "shadows.maps", "shadows.filter", "shadows.filter_taps",
                                         "grass.reach"};

TEST(EditDistance, counts_inserted_deleted_replaced_and_swapped_characters) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("render", "render"), 0u);
  EXPECT_EQ(edit_distance("rendr", "render"), 1u);
  EXPECT_EQ(edit_distance("rennder", "render"), 1u);
  EXPECT_EQ(edit_distance("rander", "render"), 1u);
  EXPECT_EQ(edit_distance("redner", "render"), 1u) << "two neighbours swapped are one edit";
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
}

TEST(EditDistance, does_not_count_the_case_of_ascii_letters) {
  EXPECT_EQ(edit_distance("Court", "cOURT"), 0u);
  EXPECT_EQ(edit_distance("[", "{"), 1u) << "not letters, though 32 apart as letters of two cases are";
}

TEST(NearestName, is_the_one_that_takes_the_fewest_edits) {
  EXPECT_EQ(nearest_name("shadow.filter", kKnobs), "shadows.filter");
  EXPECT_EQ(nearest_name("shadows.fitler_taps", kKnobs), "shadows.filter_taps");
  EXPECT_EQ(nearest_name("Lights.Culling", kKnobs), "lights.culling");
}

TEST(NearestName, is_the_first_of_several_equally_near) {
  const std::vector<std::string> lamps = {"lamp 1", "lamp 2", "lamp 3"};
  EXPECT_EQ(nearest_name("lamp 9", lamps), "lamp 1");
  EXPECT_EQ(nearest_name("LAMP 2", lamps), "lamp 2");
}

TEST(NearestName, is_empty_when_every_name_is_far_for_its_length) {
  EXPECT_EQ(nearest_name("water.level", kKnobs), "");
  EXPECT_EQ(nearest_name("", kKnobs), "");
  EXPECT_EQ(nearest_name("shadows.filter", {}), "");
  const std::vector<std::string> short_names = {"a", "to", "sun"};
  EXPECT_EQ(nearest_name("b", short_names), "") << "one edit makes any letter of any other";
  EXPECT_EQ(nearest_name("of", short_names), "");
  EXPECT_EQ(nearest_name("son", short_names), "sun");
  EXPECT_EQ(nearest_name("moon", short_names), "");
}

TEST(NearestName, is_not_looked_for_when_the_name_is_longer_than_any_name_would_be) {
  const std::string text(200, 'x');
  EXPECT_EQ(nearest_name(text, std::vector<std::string>{text}), "");
}

TEST(DidYouMean, stands_before_a_list_or_is_empty) {
  EXPECT_EQ(did_you_mean("shadow.filter", kKnobs), "did you mean shadows.filter? ");
  EXPECT_EQ(did_you_mean("water.level", kKnobs), "");
}

TEST(NearestName, valid_names_are_listed_in_their_order_after_the_nearest_one) {
  const std::vector<std::string> names = {"walk", "idle", "run"};
  EXPECT_EQ(valid_names("wlak", names), "did you mean walk? there are walk, idle, run");
  EXPECT_EQ(valid_names("swim", names), "there are walk, idle, run");
  EXPECT_EQ(valid_names("idel", std::vector<std::string>{"idle"}), "did you mean idle? there are idle");
  EXPECT_EQ(valid_names("walk", {}), "there are none");
}

}  // namespace
}  // namespace gloam
