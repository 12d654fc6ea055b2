// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/start/work_beside.h"

#include <chrono>
#include <utility>

namespace gloam {
namespace {

constexpr std::chrono::milliseconds kBetweenCalls(10);

}  // namespace

WorkBeside::WorkBeside() : thread_([this](const std::stop_token& stop) { serve(stop); }) {}

Status WorkBeside::run(std::function<Status()> work, const std::function<void()>& meanwhile) {
  std::packaged_task<Status()> task(std::move(work));
  std::future<Status> result = task.get_future();
  {
    const std::lock_guard lock(mutex_);
    task_ = std::move(task);
  }
  wake_.notify_one();
  while (result.wait_for(kBetweenCalls) != std::future_status::ready) meanwhile();
  return result.get();
}

void WorkBeside::serve(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return task_.has_value(); })) {
    std::packaged_task<Status()> task = std::move(*task_);
    task_.reset();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace gloam
