// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace gloam::gpu::vulkan {

/// Defers the destruction of objects until the frames in flight have finished. Thread-safe.
class Graveyard {
 public:
  /// Calls `destroy` when all frames begun so far have finished; at once if none is in flight.
  void bury(std::function<void()> destroy);
  /// `begun`: number of frames begun so far. Objects that are buried afterwards wait for these frames.
  void set_begun(std::uint64_t begun);
  /// Destroys the objects that wait for at most `completed` frames.
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
