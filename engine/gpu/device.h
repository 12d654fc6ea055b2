// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/command_list.h"
#include "engine/gpu/types.h"

namespace gloam::gpu {

/// A GPU device, or a test double of one. Objects may be created and destroyed on any thread; frames are recorded on
/// one thread. A destroyed object is kept until all frames in flight that may use it have finished on the GPU.
class Device {
 public:
  static constexpr std::uint32_t kFramesInFlight = 2;
  static constexpr std::uint32_t kTimestampsPerFrame = 1024;

  Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  /// Asserts that no DeviceUser is left.
  virtual ~Device();

  [[nodiscard]] virtual const DeviceInfo& info() const = 0;

  /// Whether images of this format can be made for all of these uses, of any shape (volumes: without targets).
  [[nodiscard]] virtual bool supports(Format format, ImageUsage usage) const = 0;
  /// Whether CommandList::blit works from and to images of this format. Integer and depth formats are never filtered.
  [[nodiscard]] virtual bool supports_blit(Format format) const = 0;

  [[nodiscard]] virtual Result<BufferHandle> create_buffer(const BufferDesc& desc) = 0;
  /// Fails if the device does not support the format for the usage, or the size.
  [[nodiscard]] virtual Result<ImageHandle> create_image(const ImageDesc& desc) = 0;
  /// Equal descriptions return the same sampler. It lives as long as the device.
  [[nodiscard]] virtual Result<SamplerHandle> create_sampler(const SamplerDesc& desc) = 0;
  [[nodiscard]] virtual Result<PipelineHandle> create_pipeline(const ComputePipelineDesc& desc) = 0;
  [[nodiscard]] virtual Result<PipelineHandle> create_pipeline(const GraphicsPipelineDesc& desc) = 0;
  /// Creates the resources of set `set` (≥ 1). They fit every pipeline that declares this set in the same way as
  /// `like`.
  [[nodiscard]] virtual Result<ResourceSetHandle> create_resource_set(PipelineHandle like, std::uint32_t set,
                                                                      std::span<const Binding> bindings) = 0;
  virtual void destroy(BufferHandle buffer) = 0;
  virtual void destroy(ImageHandle image) = 0;
  virtual void destroy(PipelineHandle pipeline) = 0;
  virtual void destroy(ResourceSetHandle resources) = 0;

  [[nodiscard]] virtual const BufferDesc& desc(BufferHandle buffer) const = 0;
  [[nodiscard]] virtual const ImageDesc& desc(ImageHandle image) const = 0;
  /// Whether the image belongs to a window or a host, who may change its contents between frames.
  [[nodiscard]] virtual bool is_foreign(ImageHandle) const { return false; }
  /// Whether the buffer belongs to a host.
  [[nodiscard]] virtual bool is_foreign(BufferHandle) const { return false; }
  /// The mapped bytes of the whole buffer, which must be an upload or readback buffer.
  [[nodiscard]] virtual std::span<std::byte> mapped(BufferHandle buffer) = 0;

  /// Creates images that share one piece of memory: only one of them can be in use at a time. Returns one handle per
  /// description, in order. The bytes are counted once, for the module of the first image.
  [[nodiscard]] virtual Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) = 0;

  /// Requirements of an image or a buffer on a memory block. Fails as create_image and create_buffer do for the
  /// description.
  [[nodiscard]] virtual Result<MemoryNeeds> memory_needs(const ImageDesc& desc) const = 0;
  [[nodiscard]] virtual Result<MemoryNeeds> memory_needs(const BufferDesc& desc) const = 0;
  [[nodiscard]] virtual Result<MemoryHandle> create_memory(const MemoryDesc& desc) = 0;
  /// Create an image or a buffer (MemoryKind::device) inside a memory block. Places may overlap: a barrier with
  /// `before` none takes the bytes over from earlier users, which lose their contents, and must wait for them. Nothing
  /// is allocated, and no bytes are accounted.
  [[nodiscard]] virtual Result<ImageHandle> create_image(const ImageDesc& desc, const MemoryPlace& place) = 0;
  [[nodiscard]] virtual Result<BufferHandle> create_buffer(const BufferDesc& desc, const MemoryPlace& place) = 0;
  /// Objects that are placed in the block may outlive the handle; the memory is freed with the last of them.
  virtual void destroy(MemoryHandle memory) = 0;
  /// Accounts the block's bytes to these modules; the rest stays with the block's own module.
  virtual void account(MemoryHandle memory, std::span<const ModuleMemory> shares) = 0;

  /// Waits until the frame kFramesInFlight frames ago has finished on the GPU, then starts recording. Frames are
  /// numbered from 0.
  [[nodiscard]] virtual Result<CommandList*> begin_frame() = 0;
  /// The same for uploads and copies between frames: devices that record the next frame for a host
  /// (record_next_frame_into) submit this one themselves.
  [[nodiscard]] virtual Result<CommandList*> begin_side_frame() { return begin_frame(); }
  [[nodiscard]] virtual Status submit_frame() = 0;
  /// Whether the frame being recorded goes into a command buffer of the host, who submits it
  /// (record_next_frame_into): it may be abandoned only if the host is told so by an error.
  [[nodiscard]] virtual bool records_for_host() const { return false; }
  /// Ends the frame like submit_frame, but drops its commands, wherever the recording has stopped: the GPU executes
  /// none of them, and images are as the frame before has left them. The frame still completes in order, and its
  /// semaphores are waited for and signalled. submit_frame does the same if it returns an error of the recording.
  [[nodiscard]] virtual Status abandon_frame() = 0;
  /// Waits until this frame, which was submitted or abandoned, has finished on the GPU.
  [[nodiscard]] virtual Status wait_frame(std::uint64_t frame) = 0;
  [[nodiscard]] virtual std::uint64_t frame_number() const = 0;  ///< of the frame being recorded, or the next one
  /// All frames with a smaller number have finished on the GPU.
  [[nodiscard]] virtual std::uint64_t completed_frames() const = 0;
  /// The timestamps of a completed frame by index, in nanoseconds since an unspecified moment, the same for all frames;
  /// 0 where none was written. Empty if the frame has not completed or is too old.
  [[nodiscard]] virtual std::vector<std::uint64_t> timestamps(std::uint64_t frame) = 0;
  [[nodiscard]] virtual Status wait_idle() = 0;

  [[nodiscard]] virtual std::vector<ModuleMemory> memory() const = 0;  ///< bytes per module, sorted by module name
  [[nodiscard]] virtual MemoryTotals memory_totals() const = 0;
  /// Gives memory blocks without living objects back to the driver. Destroyed objects live until the frames that may
  /// use them have finished: call wait_idle before. Without this call one empty block of each kind is kept.
  virtual void free_idle_memory() {}
  [[nodiscard]] virtual std::uint32_t pipeline_count(std::string_view module) const = 0;
  [[nodiscard]] virtual std::uint64_t validation_messages() const = 0;

 private:
  friend class DeviceUser;
  std::atomic<std::uint32_t> users_ = 0;
};

/// Member of an object that destroys its GPU objects at its end, and so must end before the device.
class DeviceUser {
 public:
  explicit DeviceUser(Device& device) : device_(device) { ++device_.users_; }
  ~DeviceUser() { --device_.users_; }
  DeviceUser(const DeviceUser&) = delete;
  DeviceUser& operator=(const DeviceUser&) = delete;

 private:
  Device& device_;
};

}  // namespace gloam::gpu
