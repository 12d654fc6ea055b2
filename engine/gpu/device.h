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

/// A GPU, or something that acts like one in tests. Objects are created and destroyed on any thread; frames are
/// recorded on one. Destroyed objects live on until the frames in flight that may use them have ended.
class Device {
 public:
  static constexpr std::uint32_t kFramesInFlight = 2;
  static constexpr std::uint32_t kTimestampsPerFrame = 1024;

  virtual ~Device() = default;

  [[nodiscard]] virtual const DeviceInfo& info() const = 0;

  [[nodiscard]] virtual Result<BufferHandle> create_buffer(const BufferDesc& desc) = 0;
  [[nodiscard]] virtual Result<ImageHandle> create_image(const ImageDesc& desc) = 0;
  /// Equal descriptions give one sampler, which lives as long as the device.
  [[nodiscard]] virtual Result<SamplerHandle> create_sampler(const SamplerDesc& desc) = 0;
  [[nodiscard]] virtual Result<PipelineHandle> create_pipeline(const ComputePipelineDesc& desc) = 0;
  [[nodiscard]] virtual Result<PipelineHandle> create_pipeline(const GraphicsPipelineDesc& desc) = 0;
  /// Resources for set `set` (≥ 1) of pipelines that declare that set as `like` does.
  [[nodiscard]] virtual Result<ResourceSetHandle> create_resource_set(PipelineHandle like, std::uint32_t set,
                                                                      std::span<const Binding> bindings) = 0;
  virtual void destroy(BufferHandle buffer) = 0;
  virtual void destroy(ImageHandle image) = 0;
  virtual void destroy(PipelineHandle pipeline) = 0;
  virtual void destroy(ResourceSetHandle resources) = 0;

  [[nodiscard]] virtual const BufferDesc& desc(BufferHandle buffer) const = 0;
  [[nodiscard]] virtual const ImageDesc& desc(ImageHandle image) const = 0;
  /// All bytes of an upload or readback buffer.
  [[nodiscard]] virtual std::span<std::byte> mapped(BufferHandle buffer) = 0;

  /// Memory two images that never live at once may share. Bytes are counted once, under `module` of the first.
  [[nodiscard]] virtual Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) = 0;

  /// Waits until the frame that used this slot before has ended, then starts recording. Frames are numbered from 0.
  [[nodiscard]] virtual Result<CommandList*> begin_frame() = 0;
  [[nodiscard]] virtual Status submit_frame() = 0;
  [[nodiscard]] virtual std::uint64_t frame_number() const = 0;  ///< of the frame being recorded, or the next one
  [[nodiscard]] virtual std::uint64_t completed_frames()
      const = 0;  ///< frames with a smaller number have ended on the GPU
  /// Timestamps of a completed frame, in nanoseconds (0 where none was written); empty when already forgotten.
  [[nodiscard]] virtual std::vector<std::uint64_t> timestamps(std::uint64_t frame) = 0;
  [[nodiscard]] virtual Status wait_idle() = 0;

  [[nodiscard]] virtual std::vector<ModuleMemory> memory() const = 0;  ///< sorted by module
  [[nodiscard]] virtual std::uint32_t pipeline_count(std::string_view module) const = 0;
  [[nodiscard]] virtual std::uint64_t validation_messages() const = 0;
};

}  // namespace gloam::gpu
