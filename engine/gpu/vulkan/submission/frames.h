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
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/startup/context.h"
#include "engine/gpu/vulkan/submission/tick_clock.h"

namespace gloam::gpu::vulkan {

/// What has become of a frame.
enum class FrameFate : std::uint8_t {
  recorded,   ///< nothing yet
  submitted,  ///< with its commands
  discarded,  ///< without them, but it waits and signals
  failed      ///< not submitted
};

/// The frames in flight: command buffers, timestamps and one timeline semaphore, whose value is the number of finished
/// frames. Frames are begun and submitted on one thread; number, completed, timestamps and wait_idle may be called on
/// any thread.
class Frames {
 public:
  static Result<std::unique_ptr<Frames>> create(Context& context, Graveyard& graveyard);
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// side_frame: Device::begin_side_frame.
  [[nodiscard]] Result<VkCommandBuffer> begin(bool side_frame = false);
  /// The next frame is recorded into this command buffer, which the owner has begun and will submit to the device's
  /// queue.
  void record_next_into(VkCommandBuffer commands);
  /// Tells that the owner of the command buffer has submitted it.
  [[nodiscard]] Status host_submitted();
  /// `discard`: drops the recorded commands, which may be incomplete; the frame is still submitted and completes in
  /// order.
  [[nodiscard]] Status submit(bool discard = false);
  /// Sets `fate` now and when the frame that is recorded ends. `fate` must live until then, or until drop_fate().
  void tell_fate(FrameFate& fate);
  void drop_fate(const FrameFate& fate);
  [[nodiscard]] bool recording() const { return recording_; }
  [[nodiscard]] std::uint64_t number() const { return number_.load(); }
  [[nodiscard]] std::uint64_t completed() const;
  [[nodiscard]] Status wait_idle();
  /// Before the objects of frames are destroyed. Tries again after an error, which does not tell that the GPU has
  /// finished, unless the device is lost.
  void wait_at_end();
  /// Waits for a submitted frame.
  [[nodiscard]] Status wait_frame(std::uint64_t frame);

  /// Device::records_for_host.
  [[nodiscard]] bool records_for_host() const {
    const Slot& slot = slots_[number() % Device::kFramesInFlight];
    return recording_ && slot.recorded != slot.commands;
  }

  void write_timestamp(std::uint32_t index);
  [[nodiscard]] std::vector<std::uint64_t> timestamps(std::uint64_t frame);

  /// Add a semaphore (of a swapchain image or a host) that the frame being recorded waits for or signals. `value`: of a
  /// timeline semaphore; ignored for a binary semaphore.
  void wait_for(VkSemaphore semaphore, std::uint64_t value = 0);
  void signal(VkSemaphore semaphore, std::uint64_t value = 0);
  /// The timeline semaphore; its value is the number of finished frames.
  [[nodiscard]] VkSemaphore timeline() const { return timeline_; }

 private:
  static constexpr std::uint64_t kRememberedFrames = 8;

  struct Slot {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkCommandBuffer recorded = VK_NULL_HANDLE;  ///< `commands`, or the host's
    VkQueryPool queries = VK_NULL_HANDLE;
    std::uint64_t frame = 0;
    std::vector<bool> written;    ///< by timestamp index: written in this frame
    bool has_timestamps = false;  ///< submitted and not yet read back
  };

  Frames(Context& context, Graveyard& graveyard)
      : context_(context),
        graveyard_(graveyard),
        clock_(context.physical.timestamp_bits, static_cast<double>(context.physical.limits.timestampPeriod)) {}
  Status make();
  Status make_slot(Slot& slot, std::uint32_t index);
  [[nodiscard]] Slot& current() { return slots_[number() % Device::kFramesInFlight]; }
  [[nodiscard]] Status wait_for_frames(std::uint64_t completed);
  [[nodiscard]] Status begin_commands(Slot& slot, VkCommandBuffer host_commands);
  /// commands: none: only waits and signals.
  [[nodiscard]] VkResult submit_commands(VkCommandBuffer commands, std::uint64_t timeline_value);
  /// Reads the timestamps of finished frames and destroys the objects that waited for these frames.
  void settle();
  void read_timestamps(Slot& slot);

  Context& context_;
  Graveyard& graveyard_;
  std::array<Slot, Device::kFramesInFlight> slots_;
  VkSemaphore timeline_ = VK_NULL_HANDLE;
  std::atomic<std::uint64_t> number_ = 0;
  bool recording_ = false;
  VkCommandBuffer host_commands_ = VK_NULL_HANDLE;  ///< of the frame that is recorded, or of the next one
  bool host_must_submit_ = false;                   ///< the newest frame's commands were recorded for the host
  FrameFate* fate_ = nullptr;                       ///< to set when the frame that is recorded ends
  std::atomic<bool> lost_ = false;
  std::vector<VkSemaphoreSubmitInfo> waits_;
  std::vector<VkSemaphoreSubmitInfo> signals_;
  std::mutex timestamps_mutex_;  ///< guards Slot::has_timestamps, clock_ and timestamps_
  TickClock clock_;
  std::map<std::uint64_t, std::vector<std::uint64_t>> timestamps_;
};

}  // namespace gloam::gpu::vulkan
