// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/jobs/pool/own_threads.h"

#include <chrono>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace gloam {
namespace {

/// The threads of this process as the system counts them; 0 if it does not tell.
std::size_t counted_threads() {
  std::error_code fault;
  const std::filesystem::directory_iterator threads("/proc/self/task", fault);
  return fault ? 0 : static_cast<std::size_t>(std::distance(begin(threads), end(threads)));
}

}  // namespace

OwnThreads::OwnThreads(std::uint32_t wanted) : kept_(wanted) {
  threads_.reserve(wanted);
  try {
    while (threads_.size() < wanted) threads_.emplace_back([this, index = threads_.size()] { run(index); });
  } catch (const std::system_error&) {  // a limit of the user, of a container or of the system
  }
}

OwnThreads::~OwnThreads() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void OwnThreads::keep(std::uint32_t count) {
  if (count >= threads_.size()) return;
  // The system counts a thread for a moment longer than join() waits.
  constexpr std::chrono::milliseconds kLongestEnd{500};
  const std::size_t ending = threads_.size() - count;
  const std::size_t before = counted_threads();
  {
    const std::lock_guard lock(mutex_);
    kept_ = count;
  }
  wake_.notify_all();
  for (std::size_t i = count; i < threads_.size(); ++i) threads_[i].join();
  threads_.resize(count);
  const auto deadline = std::chrono::steady_clock::now() + kLongestEnd;
  while (counted_threads() + ending > before && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
}

void OwnThreads::enqueue(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  wake_.notify_one();
}

void OwnThreads::run(std::size_t index) {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return end_ || index >= kept_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    const std::function<void()> task = std::move(tasks_.back());
    tasks_.pop_back();
    lock.unlock();
    task();
    lock.lock();
  }
}

}  // namespace gloam
