// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

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

/// One parallel_for or batch. Threads claim runs of ranges, as long as pays for the claim: the clock decides, not the caller. The leader
/// claims from the front and helpers from the back, so that the next loop over the same memory finds it in the caches it left it in.
class RangeRegion final : public Region {
 public:
  /// `work` has `ranges` ranges, fewer than 2^32, and must outlive the region.
  RangeRegion(std::size_t ranges, const RangeWork& work, Crew& crew);
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
    [[nodiscard]] std::size_t size() const { return end - begin; }
  };
  enum class Side : std::uint8_t { front, back };
  /// Ranges that nobody has claimed; leaves out those behind a failure, which nobody needs any more.
  [[nodiscard]] Claim unclaimed() const;
  /// Empty when nothing is left. `wanted` ≥ 1; gives fewer near the end, so that threads finish together.
  [[nodiscard]] Claim claim(Side side, std::size_t wanted);
  void run(Claim claim);
  void offer_rest(float range_ns);

  const RangeWork& work_;
  Crew& crew_;
  FirstFailure failure_;
  alignas(64) std::atomic<std::uint64_t> left_;  ///< unclaimed ranges: begin, and end << 32
};

}  // namespace gloam
