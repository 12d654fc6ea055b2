// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>

#include "engine/jobs/crew.h"
#include "engine/jobs/first_failure.h"

namespace gloam {

/// What the ranges of a region are.
class RangeWork {
 public:
  /// Runs ranges i, i + 1, … up to `end`. If one throws, `i` is that one's.
  virtual void run(std::size_t& i, std::size_t end) const = 0;

 protected:
  ~RangeWork() = default;
};

/// One parallel_for or batch. Threads claim runs of ranges, as long as pays for the claim: the clock decides, not the
/// caller.
class RangeRegion final : public Region {
 public:
  /// `work` has `ranges` ranges and must outlive the region.
  RangeRegion(std::size_t ranges, const RangeWork& work, Crew& crew) : ranges_(ranges), work_(work), crew_(crew) {}
  ~RangeRegion() { crew_.close(*this); }

  /// Runs every range; `range_ns` is what one is believed to cost. Returns what one did cost on this thread, which is
  /// 0 if helpers had claimed them all. Rethrows the exception of the lowest range that failed.
  float lead(float range_ns);

  [[nodiscard]] bool has_work() const override;
  void help() override;

 private:
  struct Claim {
    std::size_t begin = 0;  ///< ordinals of ranges
    std::size_t end = 0;
  };
  /// Empty when nothing is left. `wanted` ≥ 1; gives fewer near the end, so that threads finish together.
  [[nodiscard]] Claim claim(std::size_t wanted);
  void run(Claim claim);
  void offer_rest(std::size_t claimed_end, float range_ns);

  const std::size_t ranges_;
  const RangeWork& work_;
  Crew& crew_;
  FirstFailure failure_;
  alignas(64) std::atomic<std::size_t> next_ = 0;
};

}  // namespace gloam
