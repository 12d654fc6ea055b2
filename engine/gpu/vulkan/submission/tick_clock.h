// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace gloam::gpu::vulkan {

/// Turns the timestamps of one queue into nanoseconds that start near one second. Ticks stay integers until they are
/// differences: an absolute tick count may exceed the 53 bits of a double's mantissa, and counters of fewer than 64
/// bits wrap around, some within minutes.
class TickClock {
 public:
  /// `valid_bits`: VkQueueFamilyProperties::timestampValidBits; 0: the queue has no timestamps. `period_ns`: of a tick.
  TickClock(std::uint32_t valid_bits, double period_ns) : valid_bits_(valid_bits), period_ns_(period_ns) {}

  /// `ticks`: as read from a query; less than half of the counter's range before or after those of the last call.
  /// Greater than 0; 0 if the queue has no timestamps.
  [[nodiscard]] std::uint64_t nanoseconds(std::uint64_t ticks) {
    if (valid_bits_ == 0) return 0;
    if (started_) since_start_ += difference(ticks, last_);
    started_ = true;
    last_ = ticks;
    constexpr std::int64_t kStart = 1'000'000'000;  // ticks from before the first call stay positive
    return static_cast<std::uint64_t>(kStart + std::llround(static_cast<double>(since_start_) * period_ns_));
  }

 private:
  /// a − b where only the valid bits count: the one of both signs that is nearer to 0.
  [[nodiscard]] std::int64_t difference(std::uint64_t a, std::uint64_t b) const {
    const std::uint32_t unused = valid_bits_ < 64 ? 64 - valid_bits_ : 0;
    return static_cast<std::int64_t>((a - b) << unused) >> unused;
  }

  std::uint32_t valid_bits_;
  double period_ns_;
  bool started_ = false;
  std::uint64_t last_ = 0;
  std::int64_t since_start_ = 0;  ///< ticks
};

}  // namespace gloam::gpu::vulkan
