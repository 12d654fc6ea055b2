// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gloam {

/// Threads that are started at once, as many as the system gives the process. They run tasks until the destructor,
/// which waits until all tasks have run.
class OwnThreads {
 public:
  explicit OwnThreads(std::uint32_t wanted);
  ~OwnThreads();
  OwnThreads(const OwnThreads&) = delete;
  OwnThreads& operator=(const OwnThreads&) = delete;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(threads_.size()); }
  /// Ends all threads but `count`, and waits until the system does not count them any more. No task may be there.
  void keep(std::uint32_t count);
  /// Needs at least one thread.
  void enqueue(std::function<void()> task);

 private:
  void run(std::size_t index);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::function<void()>> tasks_;
  std::size_t kept_;  ///< threads of this and greater indices end
  bool end_ = false;  ///< after the last task
  std::vector<std::thread> threads_;
};

}  // namespace gloam
