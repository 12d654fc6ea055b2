// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace gloam::gpu::vulkan {

/// Destruction that waits for the frames in flight. Thread-safe.
class Graveyard {
 public:
  /// Calls `destroy` once all frames that were begun until now have ended; at once when none is in flight.
  void bury(std::function<void()> destroy);
  /// `begun`: frames begun so far; what is buried from now on waits for them.
  void set_begun(std::uint64_t begun);
  /// Destroys what waited for no more than `completed` frames.
  void collect(std::uint64_t completed);
  void collect_all();

 private:
  struct Grave {
    std::uint64_t frames = 0;
    std::function<void()> destroy;
  };
  std::mutex mutex_;
  std::uint64_t begun_ = 0;
  std::uint64_t completed_ = 0;
  std::vector<Grave> graves_;
};

}  // namespace gloam::gpu::vulkan
