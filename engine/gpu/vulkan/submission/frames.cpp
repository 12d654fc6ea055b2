// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/frames.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

VkSemaphoreSubmitInfo at_all_commands(VkSemaphore semaphore, std::uint64_t value) {
  return {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
          .semaphore = semaphore,
          .value = value,
          .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
}

}  // namespace

Result<std::unique_ptr<Frames>> Frames::create(Context& context, Graveyard& graveyard) {
  std::unique_ptr<Frames> frames(new Frames(context, graveyard));
  GLOAM_TRY(frames->make());
  return frames;
}

Status Frames::make() {
  const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                          .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  const VkResult result = null_on_failure(
      context_.vk.vkCreateSemaphore(context_.device, &info, context_.allocation, &timeline_), timeline_);
  if (result != VK_SUCCESS) return failure("The frame timeline could not be made", result);
  context_.set_name(VK_OBJECT_TYPE_SEMAPHORE, timeline_, "frames");
  for (std::uint32_t i = 0; i < slots_.size(); ++i) GLOAM_TRY(make_slot(slots_[i], i));
  return {};
}

Status Frames::make_slot(Slot& slot, std::uint32_t index) {
  const DeviceFunctions& vk = context_.vk;
  const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
                                        .queueFamilyIndex = context_.physical.queue_family};
  VkResult result =
      null_on_failure(vk.vkCreateCommandPool(context_.device, &pool, context_.allocation, &slot.pool), slot.pool);
  if (result != VK_SUCCESS) return failure("A command pool could not be made", result);
  const VkCommandBufferAllocateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                .commandPool = slot.pool,
                                                .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                .commandBufferCount = 1};
  result = vk.vkAllocateCommandBuffers(context_.device, &commands, &slot.commands);
  if (result != VK_SUCCESS) return failure("A command buffer could not be made", result);
  const VkQueryPoolCreateInfo queries = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                         .queryCount = Device::kTimestampsPerFrame};
  result = null_on_failure(vk.vkCreateQueryPool(context_.device, &queries, context_.allocation, &slot.queries),
                           slot.queries);
  if (result != VK_SUCCESS) return failure("A timestamp pool could not be made", result);
  const std::string name = "frame slot " + std::to_string(index);
  context_.set_name(VK_OBJECT_TYPE_COMMAND_POOL, slot.pool, name);
  context_.set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, slot.commands, name);
  context_.set_name(VK_OBJECT_TYPE_QUERY_POOL, slot.queries, name);
  return {};
}

Frames::~Frames() {
  for (const Slot& slot : slots_) {
    context_.vk.vkDestroyCommandPool(context_.device, slot.pool, context_.allocation);
    context_.vk.vkDestroyQueryPool(context_.device, slot.queries, context_.allocation);
  }
  context_.vk.vkDestroySemaphore(context_.device, timeline_, context_.allocation);
}

Status Frames::wait_for_frames(std::uint64_t completed) {
  const VkSemaphoreWaitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                    .semaphoreCount = 1,
                                    .pSemaphores = &timeline_,
                                    .pValues = &completed};
  const VkResult result = context_.vk.vkWaitSemaphores(context_.device, &wait, UINT64_MAX);
  if (result == VK_SUCCESS) return {};
  if (result == VK_ERROR_DEVICE_LOST) lost_ = true;
  return failure("Waiting for frame " + std::to_string(completed - 1), result);
}

std::uint64_t Frames::completed() const {
  std::uint64_t value = 0;
  // The result is not checked: a lost device completes no further frames.
  context_.vk.vkGetSemaphoreCounterValue(context_.device, timeline_, &value);
  return value;
}

Result<VkCommandBuffer> Frames::begin(bool side_frame) {
  GLOAM_ASSERT(!recording_, "a frame is submitted before the next one begins");
  GLOAM_ASSERT(!host_must_submit_,
               "gpu::host_submitted is called for a frame in the host's command buffer before the next frame begins");
  if (lost_) return failure("Beginning frame " + std::to_string(number()), VK_ERROR_DEVICE_LOST);
  Slot& slot = current();
  if (number() >= Device::kFramesInFlight) GLOAM_TRY(wait_for_frames(number() - Device::kFramesInFlight + 1));
  settle();
  GLOAM_TRY(begin_commands(slot, side_frame ? VK_NULL_HANDLE : host_commands_));
  {
    const std::lock_guard lock(timestamps_mutex_);
    slot.frame = number();
    slot.written.assign(Device::kTimestampsPerFrame, false);
    slot.has_timestamps = false;
  }
  recording_ = true;
  graveyard_.set_begun(number() + 1);
  return slot.recorded;
}

void Frames::record_next_into(VkCommandBuffer commands) {
  GLOAM_ASSERT(!recording_, "a frame's command buffer is given before the frame begins");
  GLOAM_ASSERT(commands != VK_NULL_HANDLE, "the host's command buffer is VK_NULL_HANDLE");
  host_commands_ = commands;
}

Status Frames::host_submitted() {
  GLOAM_ASSERT(host_must_submit_, "no frame was recorded into the host's command buffer");
  host_must_submit_ = false;
  // Signals after all that was submitted to the queue before.
  const VkResult result = submit_commands(VK_NULL_HANDLE, number());
  waits_.clear();
  signals_.clear();
  if (result == VK_SUCCESS) return {};
  lost_ = true;
  return failure("Submitting frame " + std::to_string(number() - 1), result);
}

Status Frames::begin_commands(Slot& slot, VkCommandBuffer host_commands) {
  VkResult result = context_.vk.vkResetCommandPool(context_.device, slot.pool, 0);
  slot.recorded = host_commands != VK_NULL_HANDLE ? host_commands : slot.commands;
  if (result == VK_SUCCESS && slot.recorded == slot.commands) {
    const VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                           .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    result = context_.vk.vkBeginCommandBuffer(slot.commands, &info);
  }
  if (result != VK_SUCCESS) return failure("Beginning frame " + std::to_string(number()), result);
  context_.vk.vkCmdResetQueryPool(slot.recorded, slot.queries, 0, Device::kTimestampsPerFrame);
  return {};
}

Status Frames::submit(bool discard) {
  GLOAM_ASSERT(recording_, "a frame is begun before it is submitted");
  Slot& slot = current();
  recording_ = false;
  // A discarded command buffer may be inside rendering, where it cannot be ended. begin() resets its pool.
  const bool for_host = slot.recorded != slot.commands;
  if (for_host) host_commands_ = VK_NULL_HANDLE;
  VkResult result = discard || for_host ? VK_SUCCESS : context_.vk.vkEndCommandBuffer(slot.commands);
  host_must_submit_ = for_host && !discard;
  if (host_must_submit_) {
    GLOAM_ASSERT(waits_.empty() && signals_.empty(),
                 "a frame in the host's command buffer has no semaphores of its own: the host submits it");
  } else if (result == VK_SUCCESS) {
    result = submit_commands(discard ? VK_NULL_HANDLE : slot.commands, number() + 1);
  }
  waits_.clear();
  signals_.clear();
  if (FrameFate* fate = std::exchange(fate_, nullptr))
    *fate = result != VK_SUCCESS ? FrameFate::failed : discard ? FrameFate::discarded : FrameFate::submitted;
  if (result != VK_SUCCESS) {
    // The timeline does not reach this frame: the next one has its number.
    if (result == VK_ERROR_DEVICE_LOST) lost_ = true;
    return failure("Submitting frame " + std::to_string(number()), result);
  }
  const std::lock_guard lock(timestamps_mutex_);
  slot.has_timestamps = !discard;
  ++number_;
  return {};
}

void Frames::tell_fate(FrameFate& fate) {
  GLOAM_ASSERT(recording_ && fate_ == nullptr, "one caller asks for the fate of the frame that is recorded");
  fate = FrameFate::recorded;
  fate_ = &fate;
}

void Frames::drop_fate(const FrameFate& fate) {
  if (fate_ == &fate) fate_ = nullptr;
}

void Frames::wait_for(VkSemaphore semaphore, std::uint64_t value) {
  GLOAM_ASSERT(recording_, "a frame's semaphores are given while it is recorded");
  waits_.push_back(at_all_commands(semaphore, value));
}

void Frames::signal(VkSemaphore semaphore, std::uint64_t value) {
  GLOAM_ASSERT(recording_, "a frame's semaphores are given while it is recorded");
  signals_.push_back(at_all_commands(semaphore, value));
}

VkResult Frames::submit_commands(VkCommandBuffer commands, std::uint64_t timeline_value) {
  signals_.push_back(at_all_commands(timeline_, timeline_value));
  const VkCommandBufferSubmitInfo command = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = commands};
  const VkSubmitInfo2 info = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                              .waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits_.size()),
                              .pWaitSemaphoreInfos = waits_.data(),
                              .commandBufferInfoCount = commands == VK_NULL_HANDLE ? 0u : 1u,
                              .pCommandBufferInfos = &command,
                              .signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals_.size()),
                              .pSignalSemaphoreInfos = signals_.data()};
  const std::lock_guard lock(context_.queue_mutex());
  return context_.vk.vkQueueSubmit2(context_.queue, 1, &info, VK_NULL_HANDLE);
}

Status Frames::wait_idle() {
  if (lost_) return failure("Waiting for the device", VK_ERROR_DEVICE_LOST);
  GLOAM_ASSERT(!host_must_submit_, "gpu::host_submitted is called before gloam waits for the frame");
  if (number() > 0) GLOAM_TRY(wait_for_frames(number()));
  settle();
  return {};
}

void Frames::wait_at_end() {
  constexpr int kAttempts = 10;
  for (int i = 0; i < kAttempts && !lost_ && !wait_idle().ok(); ++i) {
  }
}

Status Frames::wait_frame(std::uint64_t frame) {
  GLOAM_ASSERT(frame < number(), "a frame is submitted before it is waited for");
  GLOAM_ASSERT(!host_must_submit_ || frame + 1 < number(),
               "gpu::host_submitted is called before gloam waits for the frame");
  if (lost_) return failure("Waiting for frame " + std::to_string(frame), VK_ERROR_DEVICE_LOST);
  return wait_for_frames(frame + 1);
}

void Frames::settle() {
  const std::uint64_t ended = completed();
  {
    const std::lock_guard lock(timestamps_mutex_);
    for (Slot& slot : slots_) {
      if (slot.has_timestamps && slot.frame < ended) read_timestamps(slot);
    }
  }
  graveyard_.collect(ended);
}

void Frames::write_timestamp(std::uint32_t index) {
  GLOAM_ASSERT(index < Device::kTimestampsPerFrame, "a timestamp's index is below Device::kTimestampsPerFrame");
  Slot& slot = current();
  GLOAM_ASSERT(!slot.written[index], "a timestamp is written once a frame");
  slot.written[index] = true;
  context_.vk.vkCmdWriteTimestamp2(slot.recorded, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.queries, index);
}

void Frames::read_timestamps(Slot& slot) {
  slot.has_timestamps = false;
  const auto last = std::find(slot.written.rbegin(), slot.written.rend(), true);
  const auto count = static_cast<std::uint32_t>(slot.written.rend() - last);
  std::vector<std::uint64_t> times(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint64_t ticks = 0;
    if (!slot.written[i]) continue;
    const VkResult result = context_.vk.vkGetQueryPoolResults(context_.device, slot.queries, i, 1, sizeof ticks, &ticks,
                                                              sizeof ticks, VK_QUERY_RESULT_64_BIT);
    if (result != VK_SUCCESS) continue;
    times[i] = clock_.nanoseconds(ticks);
  }
  timestamps_[slot.frame] = std::move(times);
  while (timestamps_.size() > kRememberedFrames) timestamps_.erase(timestamps_.begin());
}

std::vector<std::uint64_t> Frames::timestamps(std::uint64_t frame) {
  const std::uint64_t ended = completed();
  const std::lock_guard lock(timestamps_mutex_);
  for (Slot& slot : slots_) {
    if (slot.has_timestamps && slot.frame < ended) read_timestamps(slot);
  }
  const auto found = timestamps_.find(frame);
  return found == timestamps_.end() ? std::vector<std::uint64_t>() : found->second;
}

}  // namespace gloam::gpu::vulkan
