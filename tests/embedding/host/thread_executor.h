// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/jobs/first_failure.h"
#include "engine/jobs/job_graph.h"

namespace host {

/// Runs gloam's jobs on the host's own threads: one stack of tasks under one lock. A thread that waits for a batch runs
/// tasks in the meantime, so jobs may start batches.
class ThreadExecutor final : public gloam::JobExecutor {
 public:
  explicit ThreadExecutor(std::uint32_t threads) {
    for (std::uint32_t i = 1; i < threads; ++i) {
      threads_.emplace_back([this] { work_until([this] { return stopping_; }); });
    }
  }
  ~ThreadExecutor() override {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  [[nodiscard]] std::uint32_t worker_count() const override { return static_cast<std::uint32_t>(threads_.size()) + 1; }

  void run(std::span<const std::function<void()>> jobs) override {
    run_all(jobs.size(), [&](std::size_t i) { jobs[i](); });
  }

  void parallel_for(std::size_t count, std::size_t grain, const std::function<void(gloam::JobRange)>& body) override {
    run_all(gloam::range_count(count, grain), [&](std::size_t i) { body(gloam::job_range(i, count, grain)); });
  }

  void run_graph(std::span<gloam::JobNode> nodes) override {
    std::vector<std::uint32_t> pending = gloam::pending_counts(nodes);
    const auto skipped = [&](std::size_t i) { return (pending[i] & gloam::kSkipNode) != 0; };
    Batch batch;
    batch.left = nodes.size();
    batch.job = [&](std::size_t i) {
      if (!skipped(i)) nodes[i].work();
    };
    batch.ended = [&](std::size_t i, bool failed) {
      for (const std::uint32_t successor : nodes[i].successors) {
        if (failed || skipped(i)) pending[successor] |= gloam::kSkipNode;
        if ((--pending[successor] & ~gloam::kSkipNode) == 0) tasks_.push_back({&batch, successor});
      }
    };
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (pending[i] == 0) ready.push_back(i);
    }
    finish(batch, ready);
  }

 private:
  struct Batch {
    std::function<void(std::size_t)> job;
    std::function<void(std::size_t, bool failed)> ended;  ///< called with the lock held
    std::size_t left = 0;                                 ///< guarded by the lock
    gloam::FirstFailure failure;
  };
  struct Task {
    Batch* batch = nullptr;
    std::size_t index = 0;
  };

  void run_all(std::size_t count, std::function<void(std::size_t)> job) {
    Batch batch;
    batch.left = count;
    batch.job = std::move(job);
    std::vector<std::size_t> ready(count);
    for (std::size_t i = 0; i < count; ++i) ready[i] = count - 1 - i;  // reversed, so that the stack pops them in order
    finish(batch, ready);
  }

  void finish(Batch& batch, std::span<const std::size_t> ready) {
    {
      const std::lock_guard lock(mutex_);
      for (const std::size_t index : ready) tasks_.push_back({&batch, index});
    }
    wake_.notify_all();
    work_until([&] { return batch.left == 0; });
    batch.failure.rethrow_if_any();
  }

  /// Runs tasks until done() returns true. done() is called with the lock held.
  template <class Done>
  void work_until(Done done) {
    std::unique_lock lock(mutex_);
    while (!done()) {
      if (tasks_.empty()) {
        wake_.wait(lock);
        continue;
      }
      const Task task = tasks_.back();
      tasks_.pop_back();
      lock.unlock();
      bool failed = false;
      try {
        task.batch->job(task.index);
      } catch (...) {
        task.batch->failure.record(task.index, std::current_exception());
        failed = true;
      }
      lock.lock();
      if (task.batch->ended) task.batch->ended(task.index, failed);
      --task.batch->left;  // the last access to the batch: the waiting thread may now destroy it
      wake_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Task> tasks_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace host
