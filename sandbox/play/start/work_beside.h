// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "engine/core/result.h"

namespace gloam {

/// A thread that runs one piece of work at a time, so that the thread of the window can handle events meanwhile.
class WorkBeside {
 public:
  WorkBeside();
  WorkBeside(const WorkBeside&) = delete;
  WorkBeside& operator=(const WorkBeside&) = delete;

  /// Runs `work` on the other thread and returns its result; an exception passes through. Calls `meanwhile` on this
  /// thread every 10 ms until the work ends; it must not throw.
  [[nodiscard]] Status run(std::function<Status()> work, const std::function<void()>& meanwhile);

 private:
  void serve(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<std::packaged_task<Status()>> task_;
  std::jthread thread_;  ///< destroyed before the members above
};

}  // namespace gloam
