// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/time_left.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(TimeLeft, items_take_as_long_as_others_of_their_kind) {
  TimeLeft left;
  left.plan({"plain", "traced", "plain", "traced", "plain"});
  EXPECT_EQ(left.seconds(), std::nullopt) << "nothing is known yet";
  left.finished(2.0);
  EXPECT_EQ(left.seconds(), 8.0) << "an unknown kind gets the mean of all";
  left.finished(100.0);
  EXPECT_EQ(left.seconds(), 2.0 + 100.0 + 2.0);
  left.finished(4.0);
  EXPECT_EQ(left.seconds(), 100.0 + 3.0);
  left.finished({});
  EXPECT_EQ(left.seconds(), 3.0) << "a result that was there says nothing of times";
  left.finished(3.0);
  EXPECT_EQ(left.seconds(), std::nullopt) << "nothing is left";
  left.finished(3.0);
}

TEST(TimeLeft, times_are_kept_for_the_next_plan) {
  TimeLeft left;
  left.plan({"plain"});
  left.finished(5.0);
  left.plan({"plain", "plain"});
  EXPECT_EQ(left.seconds(), 10.0);
}

TEST(TimeLeft, is_said_in_seconds_then_in_minutes) {
  EXPECT_EQ(time_left_text({}), "");
  EXPECT_EQ(time_left_text(0.5), "");
  EXPECT_EQ(time_left_text(20.4), ", about 20 s left");
  EXPECT_EQ(time_left_text(240.0), ", about 4 min left");
}

}  // namespace
}  // namespace gloam
