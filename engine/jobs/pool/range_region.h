// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>

#include "engine/jobs/first_failure.h"
#include "engine/jobs/pool/crew.h"

namespace gloam {

/// The work of a RangeRegion, split into ranges.
class RangeWork {
 public:
  /// Runs ranges i, i + 1, … up to, but not including, `end`, and advances `i`. If a range throws, `i` is its ordinal.
  virtual void run(std::size_t& i, std::size_t end) const = 0;

 protected:
  ~RangeWork() = default;
};

/// One parallel_for or batch. Threads claim several consecutive ranges at a time, enough for the claim to pay off. The
/// number follows from measured time, not from the caller's grain.
class RangeRegion final : public Region {
 public:
  /// `work` has `ranges` ranges and must outlive the region.
  RangeRegion(std::size_t ranges, const RangeWork& work, Crew& crew) : ranges_(ranges), work_(work), crew_(crew) {}
  ~RangeRegion() { crew_.close(*this); }

  /// Runs every range. range_ns: the expected cost of a range, in nanoseconds. Returns the measured cost of a range on
  /// this thread, or 0 if helpers claimed all ranges. Rethrows the exception of the failed range with the lowest
  /// ordinal.
  float lead(float range_ns);

  [[nodiscard]] bool has_work() const override;
  void help() override;

 private:
  struct Claim {
    std::size_t begin = 0;  ///< ordinals of ranges
    std::size_t end = 0;
  };
  /// Claims up to `wanted` ≥ 1 ranges, fewer near the end, so that threads finish together. Empty if no range is left.
  [[nodiscard]] Claim claim(std::size_t wanted);
  void run(Claim claim);
  void offer_unclaimed(std::size_t claimed_end, float range_ns);

  const std::size_t ranges_;
  const RangeWork& work_;
  Crew& crew_;
  FirstFailure failure_;
  alignas(64) std::atomic<std::size_t> next_ = 0;
};

}  // namespace gloam
