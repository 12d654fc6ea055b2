// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/device.h"

#include <utility>

#include "engine/gpu/vulkan_device.h"

namespace gloam::gpu {
namespace vulkan {
namespace {

Result<PhysicalDevice> choose_device(const Instance& instance, const VulkanOptions& options) {
  WindowNeeds window = {.present = !options.window_extensions.empty()};
  if (!window.present || !options.create_surface) return choose_physical_device(instance, options.device, window);
  window.surface = (VkSurfaceKHR)options.create_surface(instance.handle());
  if (window.surface == VK_NULL_HANDLE) {
    return Error{ErrorKind::failed, "The window has no surface that Vulkan can draw to"};
  }
  Result<PhysicalDevice> chosen = choose_physical_device(instance, options.device, window);
  instance.functions().vkDestroySurfaceKHR(instance.handle(), window.surface, nullptr);
  return chosen;
}

}  // namespace

VulkanDevice::VulkanDevice(std::unique_ptr<Instance> instance, std::unique_ptr<Context> context, const Options& options)
    : instance_(std::move(instance)),
      context_(std::move(context)),
      memory_(*context_, options.memory, options.memory_allocator),
      blocks_(memory_, graveyard_),
      buffers_(*context_, memory_, graveyard_),
      images_(*context_, memory_, graveyard_),
      samplers_(*context_),
      pipelines_(*context_, graveyard_, options.cache_directory, options.retained_pipelines),
      writer_(*context_, buffers_, images_, samplers_),
      sets_(*context_, graveyard_, writer_),
      frame_sets_(*context_) {}

Result<std::unique_ptr<Device>> VulkanDevice::create(const VulkanOptions& options) {
  Result<std::unique_ptr<Instance>> instance = Instance::create(options);
  if (!instance) return instance.error();
  Result<PhysicalDevice> physical = choose_device(**instance, options);
  if (!physical) return physical.error();
  if (options.push_descriptors == PushDescriptors::never) physical->push_descriptors = false;
  if (options.threads_in_turn) physical->info.threads_in_turn = *options.threads_in_turn;
  physical->split_selections = options.split_selections;
  Result<std::unique_ptr<Context>> context = Context::create(**instance, *physical);
  if (!context) return context.error();
  return assemble(std::move(*instance), std::move(*context),
                  {options.cache_directory, options.retained_pipelines, options.memory});
}

Result<std::unique_ptr<Device>> VulkanDevice::create_on(const HostDevice& host) {
  GLOAM_ASSERT(host.instance != VK_NULL_HANDLE && host.physical_device != VK_NULL_HANDLE &&
                   host.device != VK_NULL_HANDLE && host.queue != VK_NULL_HANDLE &&
                   host.get_instance_proc_addr != nullptr,
               "a host's device comes with its instance, physical device, queue and vkGetInstanceProcAddr");
  if (host.api_version < VK_API_VERSION_1_3) {
    return Error{ErrorKind::no_device, "The host's VkInstance was made for a Vulkan older than 1.3"};
  }
  Result<std::unique_ptr<Instance>> instance = Instance::adopt(host);
  if (!instance) return instance.error();
  const Result<PhysicalDevice> physical = examine_host_device(**instance, host);
  if (!physical) return physical.error();
  Result<std::unique_ptr<Context>> context = Context::adopt(**instance, *physical, host);
  if (!context) return context.error();
  return assemble(std::move(*instance), std::move(*context),
                  {host.cache_directory, host.retained_pipelines, host.memory, host.memory_allocator});
}

Result<std::unique_ptr<Device>> VulkanDevice::assemble(std::unique_ptr<Instance> instance,
                                                       std::unique_ptr<Context> context, const Options& options) {
  std::unique_ptr<VulkanDevice> device(new VulkanDevice(std::move(instance), std::move(context), options));
  Result<std::unique_ptr<Frames>> frames = Frames::create(*device->context_, device->graveyard_);
  if (!frames) return frames.error();
  device->frames_ = std::move(*frames);
  device->commands_ =
      std::make_unique<VulkanCommandList>(*device->context_, device->buffers_, device->images_, device->pipelines_,
                                          device->sets_, device->writer_, device->frame_sets_, *device->frames_);
  return std::unique_ptr<Device>(std::move(device));
}

VulkanDevice::~VulkanDevice() {
  // On a host's device only gloam's own work must have finished: the host may be using this queue or others meanwhile.
  if (frames_) frames_->wait_at_end();
  if (context_->owns_device()) context_->vk.vkDeviceWaitIdle(context_->device);
  graveyard_.collect_all();
}

Result<CommandList*> VulkanDevice::begin(bool side_frame) {
  const Result<VkCommandBuffer> commands = frames_->begin(side_frame);
  if (!commands) return commands.error();
  frame_sets_.begin(frames_->number());
  commands_->start(*commands);
  return static_cast<CommandList*>(commands_.get());
}

Status VulkanDevice::submit_frame() {
  GLOAM_ASSERT(!frames_->recording() || !commands_->native(),
               "native commands are ended before the frame is submitted");
  GLOAM_ASSERT(!frames_->recording() || !commands_->rendering(), "rendering is ended before the frame is submitted");
  const std::optional<Error>& fault = commands_->fault();
  if (!fault) {
    Status submitted = frames_->submit();
    if (!submitted.ok()) commands_->forget_barriers();
    return submitted;
  }
  GLOAM_TRY(abandon_frame());
  return *fault;
}

Status VulkanDevice::abandon_frame() {
  commands_->forget_barriers();
  return frames_->submit(true);
}

}  // namespace vulkan

Result<std::unique_ptr<Device>> create_vulkan_device(const VulkanOptions& options) {
  return vulkan::VulkanDevice::create(options);
}

}  // namespace gloam::gpu
