// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

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

  virtual ~Device() = default;

  [[nodiscard]] virtual const DeviceInfo& info() const = 0;

  [[nodiscard]] virtual Result<BufferHandle> create_buffer(const BufferDesc& desc) = 0;
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
  /// The mapped bytes of the whole buffer, which must be an upload or readback buffer.
  [[nodiscard]] virtual std::span<std::byte> mapped(BufferHandle buffer) = 0;

  /// Creates images that share one piece of memory: only one of them can be in use at a time. Returns one handle per
  /// description, in order. The bytes are counted once, for the module of the first image.
  [[nodiscard]] virtual Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) = 0;

  /// Waits until the frame kFramesInFlight frames ago has finished on the GPU, then starts recording. Frames are
  /// numbered from 0.
  [[nodiscard]] virtual Result<CommandList*> begin_frame() = 0;
  [[nodiscard]] virtual Status submit_frame() = 0;
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
  [[nodiscard]] virtual std::uint32_t pipeline_count(std::string_view module) const = 0;
  [[nodiscard]] virtual std::uint64_t validation_messages() const = 0;
};

}  // namespace gloam::gpu
