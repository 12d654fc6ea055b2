// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/summary.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(Summary, quantiles_lie_between_neighbours) {
  const Summary odd = summarize({5.0, 1.0, 3.0});
  EXPECT_DOUBLE_EQ(odd.median, 3.0);
  EXPECT_DOUBLE_EQ(odd.p10, 1.4);
  EXPECT_DOUBLE_EQ(odd.p90, 4.6);
  EXPECT_DOUBLE_EQ(summarize({4.0, 1.0}).median, 2.5);
}

TEST(Summary, one_value_is_all_three) {
  const Summary one = summarize({7.0});
  EXPECT_EQ(one.median, 7.0);
  EXPECT_EQ(one.p10, 7.0);
  EXPECT_EQ(one.p90, 7.0);
}

TEST(Summary, nothing_is_zero) { EXPECT_EQ(summarize({}).median, 0.0); }

}  // namespace
}  // namespace gloam
