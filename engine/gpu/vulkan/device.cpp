// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/device.h"

#include <utility>

#include "engine/gpu/vulkan_device.h"

namespace gloam::gpu {
namespace vulkan {

VulkanDevice::VulkanDevice(std::unique_ptr<Instance> instance, std::unique_ptr<Context> context,
                           const std::string& cache_directory)
    : instance_(std::move(instance)),
      context_(std::move(context)),
      memory_(*context_),
      buffers_(*context_, memory_, graveyard_),
      images_(*context_, memory_, graveyard_),
      samplers_(*context_),
      pipelines_(*context_, graveyard_, cache_directory),
      writer_(*context_, buffers_, images_, samplers_),
      sets_(*context_, graveyard_, writer_) {}

Result<std::unique_ptr<Device>> VulkanDevice::create(const VulkanOptions& options) {
  Result<std::unique_ptr<Instance>> instance = Instance::create(options);
  if (!instance) return instance.error();
  const bool for_window = !options.window_extensions.empty();
  const Result<PhysicalDevice> physical = choose_physical_device(**instance, options.device, for_window);
  if (!physical) return physical.error();
  Result<std::unique_ptr<Context>> context = Context::create(**instance, *physical);
  if (!context) return context.error();
  std::unique_ptr<VulkanDevice> device(
      new VulkanDevice(std::move(*instance), std::move(*context), options.cache_directory));
  Result<std::unique_ptr<Frames>> frames = Frames::create(*device->context_, device->graveyard_);
  if (!frames) return frames.error();
  device->frames_ = std::move(*frames);
  device->commands_ =
      std::make_unique<VulkanCommandList>(*device->context_, device->buffers_, device->images_, device->pipelines_,
                                          device->sets_, device->writer_, *device->frames_);
  return std::unique_ptr<Device>(std::move(device));
}

VulkanDevice::~VulkanDevice() {
  context_->vk.vkDeviceWaitIdle(context_->device);
  graveyard_.collect_all();
}

Result<CommandList*> VulkanDevice::begin_frame() {
  const Result<VkCommandBuffer> commands = frames_->begin();
  if (!commands) return commands.error();
  commands_->start(*commands);
  return static_cast<CommandList*>(commands_.get());
}

Status VulkanDevice::submit_frame() {
  const std::optional<Error>& fault = commands_->fault();
  GLOAM_TRY(frames_->submit(fault.has_value()));
  if (fault) return *fault;
  return {};
}

}  // namespace vulkan

Result<std::unique_ptr<Device>> create_vulkan_device(const VulkanOptions& options) {
  return vulkan::VulkanDevice::create(options);
}

}  // namespace gloam::gpu
