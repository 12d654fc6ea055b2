// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/time_plan.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

/// Measures rows that take `other_s` beside their pairs, each of which takes pair_s. Counts pairs.
class Rows {
 public:
  Rows(double total_s, double other_s, double pair_s)
      : other_s_(other_s), pair_s_(pair_s), plan_(total_s, [this] { return now_s; }) {}

  /// The pairs of the row that is measured.
  int measure(std::size_t left, std::size_t left_timed, bool timed = true) {
    constexpr int kLeast = 6, kMost = 40;
    plan_.begin_row(left, left_timed);
    now_s += 0.5 * other_s_;
    int pairs = 0;
    if (timed) {
      const auto spent = plan_.begin_timing(1);
      do now_s += pair_s_;
      while (++pairs < kMost && !(spent && pairs >= kLeast && spent()));
      plan_.end_timing();
    }
    now_s += 0.5 * other_s_;
    plan_.end_row();
    return pairs;
  }

  double now_s = 100.0;

 private:
  double other_s_, pair_s_;
  TimePlan plan_;
};

TEST(TimePlan, without_a_limit_never_ends_a_row) {
  Rows rows(0.0, 1.0, 1.0);
  for (std::size_t left = 5; left > 0; --left) EXPECT_EQ(rows.measure(left, left), 40);
}

TEST(TimePlan, ends_all_rows_in_time_when_pairs_are_slow) {
  Rows rows(600.0, 1.5, 0.3);
  for (std::size_t left = 130; left > 0; --left) EXPECT_GE(rows.measure(left, left), 6);
  EXPECT_NEAR(rows.now_s, 700.0, 10.0);
}

TEST(TimePlan, gives_the_time_of_untimed_rows_to_the_others) {
  Rows rows(600.0, 1.5, 0.3);
  std::size_t timed = 65;
  for (std::size_t left = 130; left > 0; --left) {
    const bool is_timed = left % 2 == 0;
    rows.measure(left, timed, is_timed);
    timed -= is_timed ? 1 : 0;
  }
  EXPECT_NEAR(rows.now_s, 700.0, 10.0);
}

TEST(TimePlan, gives_the_time_that_quiet_rows_leave_to_noisy_ones) {
  Rows rows(100.0, 0.0, 1.0);
  EXPECT_NEAR(rows.measure(10, 10), 10, 1);
  rows.now_s -= 5.0;  // as if it had needed five pairs only
  EXPECT_NEAR(rows.measure(2, 2), 47, 8);
}

TEST(TimePlan, of_too_little_time_leaves_each_row_its_six_pairs) {
  Rows rows(1.0, 1.0, 1.0);
  for (std::size_t left = 5; left > 0; --left) EXPECT_EQ(rows.measure(left, left), 6);
}

}  // namespace
}  // namespace gloam
