// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/gpu/vulkan/context.h"
#include "engine/gpu/vulkan/graveyard.h"

namespace gloam::gpu::vulkan {

/// Frames in flight: command buffers, timestamps and one timeline semaphore, whose value is the number of frames that
/// have ended. Frames are begun and submitted on one thread; numbers, timestamps and waiting are for any thread.
class Frames {
 public:
  static Result<std::unique_ptr<Frames>> create(Context& context, Graveyard& graveyard);
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  [[nodiscard]] Result<VkCommandBuffer> begin();
  /// `discard`: the recorded commands are dropped; the frame still ends, in its turn.
  [[nodiscard]] Status submit(bool discard = false);
  [[nodiscard]] bool recording() const { return recording_; }
  [[nodiscard]] std::uint64_t number() const { return number_.load(); }
  [[nodiscard]] std::uint64_t completed() const;
  [[nodiscard]] Status wait_idle();

  void write_timestamp(std::uint32_t index);
  [[nodiscard]] std::vector<std::uint64_t> timestamps(std::uint64_t frame);

  /// Semaphores of a window's picture or of a host, for the frame being recorded. `value`: of a timeline semaphore.
  void wait_for(VkSemaphore semaphore, std::uint64_t value = 0);
  void signal(VkSemaphore semaphore, std::uint64_t value = 0);
  /// Its value is the number of frames that have ended.
  [[nodiscard]] VkSemaphore timeline() const { return timeline_; }

 private:
  static constexpr std::uint64_t kRememberedFrames = 8;

  struct Slot {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkQueryPool queries = VK_NULL_HANDLE;
    std::uint64_t frame = 0;
    std::vector<bool> written;    ///< timestamps of this frame
    bool has_timestamps = false;  ///< submitted and not yet read back
  };

  Frames(Context& context, Graveyard& graveyard) : context_(context), graveyard_(graveyard) {}
  Status make();
  Status make_slot(Slot& slot, std::uint32_t index);
  [[nodiscard]] Slot& current() { return slots_[number() % Device::kFramesInFlight]; }
  [[nodiscard]] Status wait_for_frames(std::uint64_t completed);
  [[nodiscard]] Status begin_commands(Slot& slot);
  [[nodiscard]] VkResult submit_commands(const Slot& slot, bool discard);
  /// Reads timestamps of ended frames and lets go of what waited for them.
  void settle();
  void read_timestamps(Slot& slot);

  Context& context_;
  Graveyard& graveyard_;
  std::array<Slot, Device::kFramesInFlight> slots_;
  VkSemaphore timeline_ = VK_NULL_HANDLE;
  std::atomic<std::uint64_t> number_ = 0;
  bool recording_ = false;
  std::atomic<bool> lost_ = false;
  std::vector<VkSemaphoreSubmitInfo> waits_;
  std::vector<VkSemaphoreSubmitInfo> signals_;
  std::mutex timestamps_mutex_;  ///< guards Slot::has_timestamps and what follows
  std::map<std::uint64_t, std::vector<std::uint64_t>> timestamps_;
};

}  // namespace gloam::gpu::vulkan
