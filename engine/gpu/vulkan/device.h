// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/gpu/vulkan/binding/frame_sets.h"
#include "engine/gpu/vulkan/binding/resource_sets.h"
#include "engine/gpu/vulkan/compile/pipelines.h"
#include "engine/gpu/vulkan/resources/buffers.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/resources/images.h"
#include "engine/gpu/vulkan/resources/memory.h"
#include "engine/gpu/vulkan/resources/memory_blocks.h"
#include "engine/gpu/vulkan/resources/samplers.h"
#include "engine/gpu/vulkan/startup/context.h"
#include "engine/gpu/vulkan/startup/instance.h"
#include "engine/gpu/vulkan/submission/command_list.h"
#include "engine/gpu/vulkan/submission/frames.h"

namespace gloam::gpu::vulkan {

/// The Vulkan implementation of Device. It owns the parts of this layer and forwards each call to the responsible part.
class VulkanDevice final : public Device {
 public:
  static Result<std::unique_ptr<Device>> create(const VulkanOptions& options);
  static Result<std::unique_ptr<Device>> create_on(const HostDevice& host);
  ~VulkanDevice() override;

  [[nodiscard]] const DeviceInfo& info() const override { return context_->physical.info; }
  [[nodiscard]] bool supports(Format format, ImageUsage usage) const override {
    return vulkan::supports(*context_, format, usage);
  }
  [[nodiscard]] bool supports_blit(Format format) const override { return vulkan::supports_blit(*context_, format); }
  [[nodiscard]] Result<BufferHandle> create_buffer(const BufferDesc& desc) override { return buffers_.create(desc); }
  [[nodiscard]] Result<ImageHandle> create_image(const ImageDesc& desc) override { return images_.create(desc); }
  [[nodiscard]] Result<SamplerHandle> create_sampler(const SamplerDesc& desc) override {
    return samplers_.find_or_create(desc);
  }
  [[nodiscard]] Result<PipelineHandle> create_pipeline(const ComputePipelineDesc& desc) override {
    return pipelines_.create(desc);
  }
  [[nodiscard]] Result<PipelineHandle> create_pipeline(const GraphicsPipelineDesc& desc) override {
    return pipelines_.create(desc);
  }
  [[nodiscard]] Result<ResourceSetHandle> create_resource_set(PipelineHandle like, std::uint32_t set,
                                                              std::span<const Binding> bindings) override {
    return sets_.create(pipelines_.get(like), set, bindings);
  }
  void destroy(BufferHandle buffer) override { buffers_.destroy(buffer); }
  void destroy(ImageHandle image) override { images_.destroy(image); }
  void destroy(PipelineHandle pipeline) override { pipelines_.destroy(pipeline); }
  void destroy(ResourceSetHandle resources) override { sets_.destroy(resources); }
  [[nodiscard]] const BufferDesc& desc(BufferHandle buffer) const override { return buffers_.get(buffer).desc; }
  [[nodiscard]] const ImageDesc& desc(ImageHandle image) const override { return images_.get(image).desc; }
  [[nodiscard]] std::span<std::byte> mapped(BufferHandle buffer) override { return buffers_.mapped(buffer); }
  [[nodiscard]] Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) override {
    return images_.create_aliased(descs);
  }

  [[nodiscard]] Result<MemoryNeeds> memory_needs(const ImageDesc& desc) const override { return images_.needs(desc); }
  [[nodiscard]] Result<MemoryNeeds> memory_needs(const BufferDesc& desc) const override { return buffers_.needs(desc); }
  [[nodiscard]] Result<MemoryHandle> create_memory(const MemoryDesc& desc) override { return blocks_.create(desc); }
  [[nodiscard]] Result<ImageHandle> create_image(const ImageDesc& desc, const MemoryPlace& place) override {
    return images_.create_in(desc, blocks_.get(place.memory), place.offset);
  }
  [[nodiscard]] Result<BufferHandle> create_buffer(const BufferDesc& desc, const MemoryPlace& place) override {
    return buffers_.create_in(desc, blocks_.get(place.memory), place.offset);
  }
  void destroy(MemoryHandle memory) override { blocks_.destroy(memory); }
  void account(MemoryHandle memory, std::span<const ModuleMemory> shares) override { blocks_.account(memory, shares); }

  [[nodiscard]] Result<CommandList*> begin_frame() override { return begin(false); }
  [[nodiscard]] Result<CommandList*> begin_side_frame() override { return begin(true); }
  [[nodiscard]] Status submit_frame() override;
  [[nodiscard]] Status abandon_frame() override;
  [[nodiscard]] bool records_for_host() const override { return frames_->records_for_host(); }
  [[nodiscard]] bool is_foreign(ImageHandle image) const override { return !images_.get(image).memory; }
  [[nodiscard]] bool is_foreign(BufferHandle buffer) const override { return !buffers_.get(buffer).memory; }
  [[nodiscard]] Status wait_frame(std::uint64_t frame) override { return frames_->wait_frame(frame); }
  [[nodiscard]] std::uint64_t frame_number() const override { return frames_->number(); }
  [[nodiscard]] std::uint64_t completed_frames() const override { return frames_->completed(); }
  [[nodiscard]] std::vector<std::uint64_t> timestamps(std::uint64_t frame) override {
    return frames_->timestamps(frame);
  }
  [[nodiscard]] Status wait_idle() override { return frames_->wait_idle(); }
  [[nodiscard]] std::vector<ModuleMemory> memory() const override { return memory_.usage(); }
  [[nodiscard]] MemoryTotals memory_totals() const override { return memory_.totals(); }
  void free_idle_memory() override { memory_.free_empty_blocks(); }
  [[nodiscard]] std::uint32_t pipeline_count(std::string_view module) const override {
    return pipelines_.count(module);
  }
  [[nodiscard]] std::uint64_t validation_messages() const override { return instance_->messages(); }

  // For the swapchain and vulkan_interop.h.
  [[nodiscard]] Context& context() { return *context_; }
  [[nodiscard]] Buffers& buffers() { return buffers_; }
  [[nodiscard]] Images& images() { return images_; }
  [[nodiscard]] Frames& frames() { return *frames_; }
  // For tests.
  [[nodiscard]] const FrameSets& frame_sets() const { return frame_sets_; }

 private:
  [[nodiscard]] Result<CommandList*> begin(bool side_frame);
  /// The options of both kinds of devices.
  struct Options {
    const std::string& cache_directory;
    std::size_t retained_pipelines = 0;
    MemoryOptions memory;
    HostMemoryAllocator* memory_allocator = nullptr;
  };
  VulkanDevice(std::unique_ptr<Instance> instance, std::unique_ptr<Context> context, const Options& options);
  static Result<std::unique_ptr<Device>> assemble(std::unique_ptr<Instance> instance, std::unique_ptr<Context> context,
                                                  const Options& options);

  // In dependency order; destroyed in reverse order.
  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Context> context_;
  Graveyard graveyard_;
  MemoryAllocator memory_;
  MemoryBlocks blocks_;
  Buffers buffers_;
  Images images_;
  Samplers samplers_;
  Pipelines pipelines_;
  DescriptorWriter writer_;
  ResourceSets sets_;
  FrameSets frame_sets_;
  std::unique_ptr<Frames> frames_;
  std::unique_ptr<VulkanCommandList> commands_;
};

}  // namespace gloam::gpu::vulkan
