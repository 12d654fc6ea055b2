// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/resources.h"

#include <gmock/gmock.h>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SceneNames, resolve_within_their_kind) {
  SceneNames names;
  names.add("camera", "lawn", {1, 1});
  names.add("mesh", "lawn", {2, 1});
  EXPECT_EQ(*names.find("camera", "lawn"), (Entity{1, 1}));
  EXPECT_EQ(*names.find("mesh", "lawn"), (Entity{2, 1}));
}

TEST(SceneNames, an_absent_name_is_a_usage_error_that_lists_the_valid_ones) {
  SceneNames names;
  names.add("camera", "court", {1, 1});
  names.add("camera", "lawn", {2, 1});
  const Result<Entity> found = names.find("camera", "roof");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().kind, ErrorKind::usage);
  EXPECT_EQ(found.error().message, "no camera is named \"roof\"; there are court, lawn");
  EXPECT_EQ(names.find("light", "roof").error().message, "no light is named \"roof\"; there are none");
}

TEST(SceneNames, a_kind_of_any_text_is_told_in_one_line) {
  const std::string message = SceneNames().find("\n", "b").error().message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(SceneNames, a_misspelt_name_is_answered_with_the_nearest_one_before_the_list) {
  SceneNames names;
  names.add("camera", "court", {1, 1});
  names.add("camera", "lawn", {2, 1});
  names.add("light", "long", {3, 1});
  EXPECT_EQ(names.find("camera", "Cuort").error().message,
            "no camera is named \"Cuort\"; did you mean court? there are court, lawn");
  EXPECT_EQ(names.find("camera", "lon").error().message, "no camera is named \"lon\"; there are court, lawn")
      << "names of another kind are no answer";
}

// Hard case: scene.name_twice
TEST(SceneNames, a_name_that_two_share_is_an_error_only_when_used) {
  SceneNames names;
  names.add("light", "torch", {1, 1});
  names.add("light", "torch", {2, 1});
  names.add("light", "key", {3, 1});
  EXPECT_TRUE(names.find("light", "key").ok());
  const Result<Entity> found = names.find("light", "torch");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().kind, ErrorKind::input);
  EXPECT_THAT(found.error().message, ::testing::HasSubstr("\"torch\" is used by 2 light nodes"));
}

TEST(SceneNames, are_listed_in_the_order_of_adding_and_found_by_entity) {
  SceneNames names;
  names.add("camera", "b", {1, 1});
  names.add("camera", "a", {2, 1});
  names.add("node", "tripod", {1, 1});
  EXPECT_THAT(names.names("camera"), ElementsAre("b", "a"));
  EXPECT_THAT(names.names("light"), IsEmpty());
  EXPECT_EQ(names.name_of({1, 1}), "tripod");
  EXPECT_EQ(names.name_of({2, 1}), "a");
  EXPECT_EQ(names.name_of({3, 1}), "");
}

TEST(SceneStrings, the_same_text_has_one_number_and_zero_is_empty) {
  SceneStrings strings;
  EXPECT_EQ(strings.intern(""), 0u);
  const std::uint32_t id = strings.intern("window.png");
  EXPECT_NE(id, 0u);
  EXPECT_EQ(strings.intern("window.png"), id);
  EXPECT_EQ(strings.text(id), "window.png");
  EXPECT_EQ(strings.text(0), "");
  EXPECT_ASSERT((void)strings.text(99), "a string's number comes from intern");
}

}  // namespace
}  // namespace gloam
