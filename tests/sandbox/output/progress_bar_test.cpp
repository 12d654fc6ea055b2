// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/progress_bar.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(progress_line, fills_with_what_is_done) {
  EXPECT_EQ(progress_line(0, 8, "a=b", 0, 0.0), "[----------------]  0 of 8  a=b");
  EXPECT_EQ(progress_line(4, 8, "a=b", 0, 0.0), "[########--------]  4 of 8  a=b");
  EXPECT_EQ(progress_line(8, 8, "a=b", 8, 80.0), "[################]  8 of 8  a=b");
}

TEST(progress_line, estimates_from_what_was_measured_alone) {
  EXPECT_EQ(progress_line(6, 8, "a=b", 2, 20.0), "[############----]  6 of 8  a=b, about 20 s left");
  EXPECT_EQ(progress_line(1, 61, "a=b", 1, 4.0), "[----------------]  1 of 61  a=b, about 4 min left");
  EXPECT_EQ(progress_line(1, 2, "a=b", 1, 0.1), "[########--------]  1 of 2  a=b");
}

TEST(progress_line, of_nothing_is_full) { EXPECT_EQ(progress_line(0, 0, "", 0, 0.0), "[################]  0 of 0  "); }

}  // namespace
}  // namespace gloam
