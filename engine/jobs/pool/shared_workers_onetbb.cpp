// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <mutex>
#include <optional>
#include <set>

#include "engine/jobs/pool/shared_workers.h"

namespace gloam {
namespace {

/// Raises oneTBB's thread limit for a crew that has more threads than cores. By default oneTBB has one worker fewer
/// than cores. Limits are process-wide and oneTBB applies the smallest, so the process keeps only one limit: the
/// largest that any of these crews asks for.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::uint32_t threads) : threads_(threads) {
    if (threads_ <= SharedWorkers::core_count()) return;
    Shared& all = shared();
    const std::lock_guard lock(all.mutex);
    all.wishes.insert(threads_);
    all.grant_largest();
  }
  ~ThreadLimit() {
    if (threads_ <= SharedWorkers::core_count()) return;
    Shared& all = shared();
    const std::lock_guard lock(all.mutex);
    all.wishes.erase(all.wishes.find(threads_));
    all.grant_largest();
  }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Shared {
    void grant_largest() {
      control.reset();
      if (!wishes.empty()) control.emplace(tbb::global_control::max_allowed_parallelism, *wishes.rbegin());
    }
    std::mutex mutex;
    std::multiset<std::uint32_t> wishes;
    std::optional<tbb::global_control> control;
  };
  static Shared& shared() {
    static Shared& shared = *new Shared;  // never destroyed: executors in static variables end after main
    return shared;
  }
  const std::uint32_t threads_;
};

/// oneTBB is not instrumented, so ThreadSanitizer does not see the hand-over of this object to the worker. Only the
/// reads of its members are excluded from the checks.
struct Visit {
  void (*visit)(void* state);
  void* state;
  __attribute__((no_sanitize("thread"))) void operator()() const { visit(state); }
};

/// oneTBB ends the process where one of its workers cannot start another one.
class OneTbbWorkers final : public SharedWorkers {
 public:
  explicit OneTbbWorkers(std::uint32_t threads) : limit_(threads), arena_(static_cast<int>(threads), 1) {}
  ~OneTbbWorkers() noexcept override {
    arena_.execute([this] { visits_.wait(); });
  }
  void enqueue(void (*visit)(void* state), void* state) override { arena_.enqueue(visits_.defer(Visit{visit, state})); }

 private:
  ThreadLimit limit_;
  tbb::task_arena arena_;
  tbb::task_group visits_;  ///< so that the destructor can wait for visits that have not begun
};

}  // namespace

std::unique_ptr<SharedWorkers> SharedWorkers::create(std::uint32_t threads) {
  return std::make_unique<OneTbbWorkers>(threads);
}

bool SharedWorkers::exist() { return true; }

std::uint32_t SharedWorkers::core_count() { return static_cast<std::uint32_t>(tbb::info::default_concurrency()); }

}  // namespace gloam
