// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

namespace gloam {

/// Work shorter than this is done before a sleeping thread would have come to help.
inline constexpr float kWakeUpNs = 10'000.0f;
/// The same for a helper that is still spinning.
inline constexpr float kJoinNs = 1'500.0f;

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline float nanoseconds_between(Clock::time_point begin, Clock::time_point end) {
  return static_cast<float>(std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count());
}

/// A stretch of parallel work that lives on the stack of its leader (the thread that called the executor) and that
/// helpers may join while it is open.
///
/// Regions nest: `depth` is how many regions the leader's stack held, plus one. A thread that waits for its own region
/// helps only deeper ones, so that stacks stay as deep as the nesting, waits always lead to deeper regions, and the
/// deepest never waits: no deadlock.
class Region {
 public:
  Region();
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

  /// Is there a job that nobody has claimed? Called under the crew's lock: must be cheap and take no lock.
  [[nodiscard]] virtual bool has_work() const = 0;
  /// Claims and runs jobs until none is left to claim. Must not throw.
  virtual void help() = 0;

  [[nodiscard]] std::uint32_t depth() const { return depth_; }
  [[nodiscard]] std::uint32_t helpers() const { return helpers_.load(std::memory_order_relaxed); }

 protected:
  ~Region() = default;  // regions are never deleted through this class

 private:
  friend class Crew;
  friend struct CrewState;
  const std::uint32_t depth_;
  bool open_ = false;
  std::atomic<std::uint32_t> helpers_ = 0;
  Region* next_ = nullptr;
};

/// What the crew shares with its helpers; lives until the last of them has left.
struct CrewState {
  explicit CrewState(std::uint32_t threads);

  /// A helper's whole visit: helps, spins briefly for more, leaves.
  void visit();
  /// Helps the latest open region deeper than `depth` that has work; false if there is none.
  bool help_deeper_than(std::uint32_t depth, bool was_idle);
  /// Spins until the epoch has left `seen` or a short time has gone; true for the former.
  [[nodiscard]] bool spin(std::uint32_t seen) const;
  /// Something changed that a spinning or sleeping thread may wait for.
  void announce();
  void release();

  const bool crowded;  ///< more threads than cores: spinning would take the core from whoever has the work
  std::mutex mutex;
  std::atomic<Region*> first = nullptr;  ///< open regions, latest first; written under the mutex, looked at without
  std::atomic<std::uint32_t> epoch = 0;  ///< counts announcements
  std::atomic<std::uint32_t> sleepers = 0;
  std::atomic<std::uint32_t> idle = 0;     ///< helpers that spin, or have been called and will look for work
  std::atomic<std::uint32_t> holders = 1;  ///< the crew and the visits under way
  std::atomic<bool> closing = false;
};

/// Calls in oneTBB's workers as helpers and keeps the list of open regions.
class Crew {
 public:
  /// threads ≥ 1, the caller's included.
  explicit Crew(std::uint32_t threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  [[nodiscard]] static std::uint32_t core_count();
  [[nodiscard]] std::uint32_t threads() const { return threads_; }

  /// How long work must take for helpers to pay: less while some still spin.
  [[nodiscard]] float worthwhile_ns() const {
    return state_->idle.load(std::memory_order_relaxed) > 0 && !state_->crowded ? kJoinNs : kWakeUpNs;
  }

  /// Lets helpers see the region, and calls for up to `wanted` of them. May be called again for an open region.
  void offer(Region& region, std::uint32_t wanted);
  /// Waits until every helper has left. Afterwards the region may end. Does nothing if it was never offered.
  void close(Region& region);
  /// Waits, and helps deeper regions meanwhile, until `done`; whoever makes it true must leave the region or offer.
  void wait(const Region& region, const std::function<bool()>& done);

 private:
  struct Workers;
  void call_helpers(std::uint32_t wanted);

  const std::uint32_t threads_;
  CrewState* state_;
  std::unique_ptr<Workers> workers_;
};

/// Marks the calling thread as being inside `region`, so that regions opened meanwhile are deeper.
class InsideRegion {
 public:
  explicit InsideRegion(const Region& region);
  ~InsideRegion();
  InsideRegion(const InsideRegion&) = delete;
  InsideRegion& operator=(const InsideRegion&) = delete;

 private:
  std::uint32_t outer_depth_;
};

}  // namespace gloam
