// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace gloam {

/// Divides the time of a ledger among its rows and points, so that measuring ends in time: each gets an equal share of
/// what is left after the work that is not timing. That work is estimated from the rows before.
class TimePlan {
 public:
  /// total_s: for all rows; 0: no limit. clock: seconds, from any start.
  TimePlan(double total_s, std::function<double()> clock);
  explicit TimePlan(double total_s);

  /// Before a row is measured. left: rows and points that are not measured yet, with this one; of them, `timed` get
  /// pairs of frames.
  void begin_row(std::size_t left, std::size_t timed);
  /// Pairs of frames of `rows` rows are drawn from now on. The function tells whether their share is spent; it is null
  /// without a limit.
  [[nodiscard]] std::function<bool()> begin_timing(std::size_t rows);
  void end_timing();
  /// The row is measured, but for pairs that are drawn after it.
  void end_row();

 private:
  /// Seconds for pairs of frames of one row.
  [[nodiscard]] double share_s() const;

  double total_s_ = 0.0;
  std::function<double()> clock_;
  double start_s_ = 0.0;
  double row_s_ = 0.0;     ///< begin of the row
  double timing_s_ = 0.0;  ///< begin of its pairs
  double pairs_s_ = 0.0;   ///< time of its pairs
  std::size_t left_ = 1;
  std::size_t left_timed_ = 1;
  double other_s_ = 0.0;  ///< of finished rows: all but pairs
  std::size_t rows_ = 0;
};

}  // namespace gloam
