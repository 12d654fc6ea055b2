// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/undo_stack.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

Settings settings(const std::string& a, const std::string& b) { return {{"a", a}, {"b", b}}; }

TEST(UndoStack, takes_changes_back_and_makes_them_again_in_order) {
  UndoStack stack;
  EXPECT_FALSE(stack.undo());
  stack.note(settings("1", "x"), settings("2", "x"), false);
  stack.note(settings("2", "x"), settings("2", "y"), false);
  EXPECT_EQ(stack.undo(), (Settings{{"b", "x"}}));
  EXPECT_EQ(stack.undo(), (Settings{{"a", "1"}}));
  EXPECT_FALSE(stack.undo());
  EXPECT_EQ(stack.redo(), (Settings{{"a", "2"}}));
  EXPECT_EQ(stack.redo(), (Settings{{"b", "y"}}));
  EXPECT_FALSE(stack.redo());
}

TEST(UndoStack, leaves_settings_alone_that_the_user_has_not_changed) {
  UndoStack stack;
  stack.note(settings("1", "x"), settings("2", "x"), false);
  // A budget changes b between two frames of the panel.
  stack.note(settings("2", "z"), settings("2", "z"), false);
  EXPECT_EQ(stack.undo(), (Settings{{"a", "1"}}));
}

TEST(UndoStack, a_drag_is_one_change) {
  UndoStack stack;
  stack.note(settings("1", "x"), settings("2", "x"), true);
  stack.note(settings("2", "x"), settings("2", "x"), true);
  stack.note(settings("2", "x"), settings("3", "y"), true);
  stack.note(settings("3", "y"), settings("3", "y"), false);
  stack.note(settings("3", "y"), settings("4", "y"), false);
  EXPECT_EQ(stack.undo(), (Settings{{"a", "3"}}));
  EXPECT_EQ(stack.undo(), settings("1", "x"));
  EXPECT_EQ(stack.redo(), settings("3", "y"));
}

TEST(UndoStack, a_change_after_undo_ends_what_can_be_made_again) {
  UndoStack stack;
  stack.note(settings("1", "x"), settings("2", "x"), false);
  ASSERT_TRUE(stack.undo());
  stack.note(settings("1", "x"), settings("5", "x"), false);
  EXPECT_FALSE(stack.redo());
  EXPECT_EQ(stack.undo(), (Settings{{"a", "1"}}));
}

TEST(UndoStack, forgets_the_oldest_changes) {
  UndoStack stack;
  for (std::size_t i = 0; i <= UndoStack::kMost; ++i)
    stack.note(settings(std::to_string(i), ""), settings(std::to_string(i + 1), ""), false);
  std::size_t count = 0;
  while (stack.undo()) ++count;
  EXPECT_EQ(count, UndoStack::kMost);
}

}  // namespace
}  // namespace gloam
