// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "engine/jobs/pool/epoch.h"
#include "engine/jobs/pool/own_threads.h"
#include "engine/jobs/pool/shared_workers.h"

namespace gloam {

/// Time until a sleeping helper has woken up. Shorter work is finished before the helper arrives.
inline constexpr float kWakeUpNs = 10'000.0f;
/// The same for a helper that is spinning.
inline constexpr float kJoinNs = 1'500.0f;

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline float nanoseconds_between(Clock::time_point begin, Clock::time_point end) {
  return static_cast<float>(std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count());
}

/// One piece of parallel work. It lives on the stack of its leader (the thread that called the executor), and helpers
/// may join it while it is open.
///
/// Regions nest: `depth` is the number of regions that were on the leader's stack, plus one. While a thread waits for
/// the helpers of its own region, it helps only deeper regions. So a stack holds at most one region per level of
/// nesting, every wait is for a deeper region, and the deepest region never waits: there is no deadlock.
class Region {
 public:
  Region();
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

  /// Whether some job is unclaimed. Called under the crew's lock: must be cheap and take no lock.
  [[nodiscard]] virtual bool has_work() const = 0;
  /// Claims and runs jobs until no unclaimed job is left. Must not throw.
  virtual void help() = 0;

  [[nodiscard]] std::uint32_t depth() const { return depth_; }
  [[nodiscard]] std::uint32_t helpers() const { return helpers_.load(std::memory_order_relaxed); }

 protected:
  ~Region() = default;  // never deleted through a pointer to this class

 private:
  friend class Crew;
  friend struct CrewState;
  const std::uint32_t depth_;
  bool open_ = false;
  std::atomic<std::uint32_t> helpers_ = 0;
  Region* next_ = nullptr;
};

/// State that the crew shares with its helpers. It is deleted when the crew and the last helper have released it.
struct CrewState {
  explicit CrewState(std::uint32_t threads);

  /// One visit of a helper: it helps, spins briefly for more work and leaves.
  void visit();
  /// Helps the latest open region deeper than `depth` that has work; returns false if there is none. `was_idle`: the
  /// calling thread is counted in `idle`.
  bool help_deeper_than(std::uint32_t depth, bool was_idle);
  /// Spins until the epoch differs from `seen` (returns true) or a short time has passed (returns false).
  [[nodiscard]] bool spin(std::uint32_t seen) const;
  /// Tells spinning and sleeping threads that something they may wait for has changed.
  void announce() { epoch.announce(); }
  void release();

  const bool crowded;  ///< more threads than cores: spinning would take the core from a thread that has work
  std::mutex mutex;
  std::atomic<Region*> first = nullptr;  ///< open regions, latest first; the mutex guards writes and the links
  Epoch epoch;
  std::atomic<std::uint32_t> idle = 0;     ///< helpers that spin, or that were called and have not looked for work yet
  std::atomic<std::uint32_t> holders = 1;  ///< owners of this state: the crew and each visit, enqueued or running
  std::atomic<bool> closing = false;
};

/// Calls the shared workers as helpers, or threads of its own where there are none or threads are scarce, and keeps
/// the list of open regions.
class Crew {
 public:
  /// threads ≥ 1, including the caller's. The crew has fewer if the system does not give the process as many.
  explicit Crew(std::uint32_t threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  [[nodiscard]] static std::uint32_t core_count();
  [[nodiscard]] std::uint32_t threads() const { return threads_; }

  /// Least duration of work, in nanoseconds, for which helpers pay off: kJoinNs while a helper spins, otherwise
  /// kWakeUpNs.
  [[nodiscard]] float worthwhile_ns() const {
    return state_->idle.load(std::memory_order_relaxed) > 0 && !state_->crowded ? kJoinNs : kWakeUpNs;
  }

  /// Opens the region to helpers and calls up to `wanted` of them. May be called again for an open region.
  void offer(Region& region, std::uint32_t wanted);
  /// Closes the region and waits until every helper has left it; then the region may be destroyed. Does nothing if the
  /// region was never offered.
  void close(Region& region);
  /// Waits until done() is true, and helps deeper regions meanwhile. A thread that makes done() true must leave the
  /// region or call offer() afterwards: only that wakes the waiting thread.
  void wait(const Region& region, const std::function<bool()>& done);

 private:
  /// Threads of the crew itself: all `helpers` where there are no shared workers; at most `helpers` and half of those
  /// that the system gives the process, if oneTBB might start more than it gives; otherwise null.
  [[nodiscard]] static std::unique_ptr<OwnThreads> scarce_threads(std::uint32_t helpers);
  void call_helpers(std::uint32_t wanted);

  std::unique_ptr<OwnThreads> own_threads_;  ///< in place of workers_
  const std::uint32_t threads_;
  CrewState* state_;
  std::unique_ptr<SharedWorkers> workers_;
};

/// Marks the calling thread as being inside `region`, so that regions constructed meanwhile are deeper.
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
