// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

namespace gloam {

/// Workers that all executors of the process share: those of oneTBB. A build without oneTBB has none, and crews then
/// have threads of their own.
class SharedWorkers {
 public:
  /// Null in a build without oneTBB. threads: of the crew, ≥ 2.
  [[nodiscard]] static std::unique_ptr<SharedWorkers> create(std::uint32_t threads);
  [[nodiscard]] static bool exist();
  /// Cores that this process may use.
  [[nodiscard]] static std::uint32_t core_count();

  SharedWorkers() = default;
  SharedWorkers(const SharedWorkers&) = delete;
  SharedWorkers& operator=(const SharedWorkers&) = delete;
  /// Waits until every enqueued visit has run.
  virtual ~SharedWorkers() = default;

  /// One worker calls visit(state) soon. ThreadSanitizer does not see the hand-over to the worker: visit() must first
  /// acquire what its caller has released.
  virtual void enqueue(void (*visit)(void* state), void* state) = 0;
};

}  // namespace gloam
