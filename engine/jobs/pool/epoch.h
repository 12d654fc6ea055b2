// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace gloam {

/// Counts announcements. Threads sleep until the next one.
class Epoch {
 public:
  [[nodiscard]] std::uint32_t now(std::memory_order order) const { return count_.load(order); }

  /// Wakes all threads that sleep.
  void announce() {
    // Sequentially consistent, because a sleeper increments `sleepers_` and then waits for the count to change: either
    // this thread sees the sleeper, or the sleeper sees the new count.
    count_.fetch_add(1, std::memory_order_seq_cst);
    if (sleepers_.load(std::memory_order_seq_cst) > 0) wake();
  }

  /// Sleeps while the count is `seen`.
  void sleep(std::uint32_t seen) {
    sleepers_.fetch_add(1, std::memory_order_seq_cst);
    wait(seen);
    sleepers_.fetch_sub(1, std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint32_t> count_ = 0;
  std::atomic<std::uint32_t> sleepers_ = 0;
#ifdef __linux__
  void wake() { count_.notify_all(); }
  void wait(std::uint32_t seen) { count_.wait(seen, std::memory_order_seq_cst); }
#else
  // Where GCC 12 has no system call to wait for a value, its std::atomic::wait looks at the value before it takes the
  // lock under which it sleeps, and may sleep through the announcement in between.
  void wake() {
    { const std::lock_guard lock(mutex_); }
    changed_.notify_all();
  }
  void wait(std::uint32_t seen) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return count_.load(std::memory_order_seq_cst) != seen; });
  }
  std::mutex mutex_;
  std::condition_variable changed_;
#endif
};

}  // namespace gloam
