// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>

namespace gloam {

/// Keeps the exception of the failed job with the lowest index, regardless of the order in which jobs fail. Safe from
/// any thread.
class FirstFailure {
 public:
  /// Lowest index that failed so far; SIZE_MAX if none did. Jobs with a higher index need not start.
  [[nodiscard]] std::size_t index() const { return index_.load(std::memory_order_relaxed); }

  void record(std::size_t index, std::exception_ptr exception) {
    const std::lock_guard lock(mutex_);
    if (index >= index_.load(std::memory_order_relaxed)) return;
    index_.store(index, std::memory_order_relaxed);
    exception_ = std::move(exception);
  }

  /// Rethrows the kept exception, if there is one. Call it only when no job is running.
  void rethrow_if_any() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<std::size_t> index_ = SIZE_MAX;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

}  // namespace gloam
