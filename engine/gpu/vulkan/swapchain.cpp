// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/swapchain.h"

#include <algorithm>
#include <string>

#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"
#include "engine/gpu/vulkan/startup/listed.h"

namespace gloam::gpu {
namespace vulkan {

Result<std::unique_ptr<Swapchain>> VulkanSwapchain::create(VulkanDevice& device, VkSurfaceKHR surface) {
  std::unique_ptr<VulkanSwapchain> swapchain(new VulkanSwapchain(device, surface));
  GLOAM_TRY(swapchain->check_surface());
  GLOAM_TRY(swapchain->make_acquire_semaphores());
  return std::unique_ptr<Swapchain>(std::move(swapchain));
}

Status VulkanSwapchain::check_surface() {
  Context& context = device_.context();
  const InstanceFunctions& f = context.instance_functions();
  const VkPhysicalDevice physical = context.physical.handle;
  VkBool32 supported = VK_FALSE;
  VkResult result =
      f.vkGetPhysicalDeviceSurfaceSupportKHR(physical, context.physical.queue_family, surface_, &supported);
  if (result != VK_SUCCESS)
    return failure("The device could not be asked whether it can draw into this window", result);
  if (supported != VK_TRUE) {
    return Error{ErrorKind::no_device, "The device " + context.physical.info.name + " cannot draw into this window"};
  }
  std::vector<VkSurfaceFormatKHR> formats;
  result = list_all(formats, [&](std::uint32_t* count, VkSurfaceFormatKHR* items) {
    return f.vkGetPhysicalDeviceSurfaceFormatsKHR(physical, surface_, count, items);
  });
  if (result != VK_SUCCESS) return failure("The window's picture formats could not be listed", result);
  for (const Format wanted : {Format::bgra8_unorm, Format::rgba8_unorm}) {
    for (const VkSurfaceFormatKHR& format : formats) {
      if (format.format != to_vulkan(wanted) || format.colorSpace != VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) continue;
      format_ = format;
      return {};
    }
  }
  return Error{ErrorKind::failed, "The window has no picture format with 8 bits a channel"};
}

Result<VkSemaphore> VulkanSwapchain::make_semaphore(std::string_view name) {
  Context& context = device_.context();
  const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore semaphore = VK_NULL_HANDLE;
  const VkResult result = context.vk.vkCreateSemaphore(context.device, &info, context.allocation, &semaphore);
  if (result != VK_SUCCESS) return failure("A semaphore of the window could not be made", result);
  context.set_name(VK_OBJECT_TYPE_SEMAPHORE, semaphore, name);
  return semaphore;
}

Status VulkanSwapchain::make_acquire_semaphores() {
  for (VkSemaphore& semaphore : available_) {
    const Result<VkSemaphore> made = make_semaphore("picture available");
    if (!made) return made.error();
    semaphore = *made;
  }
  return {};
}

/// No frame has waited for the semaphore of the acquired picture: it stays signalled.
Status VulkanSwapchain::replace_ready() {
  const auto place = std::ranges::find(available_, ready_);
  if (place == available_.end()) return {};  // of a picture, and goes with it
  const Result<VkSemaphore> made = make_semaphore("picture available");
  if (!made) return made.error();
  Context& context = device_.context();
  context.vk.vkDestroySemaphore(context.device, *place, context.allocation);
  *place = *made;
  return {};
}

Status VulkanSwapchain::resize(std::uint32_t width, std::uint32_t height) {
  GLOAM_ASSERT(!device_.frames().recording(), "a window is resized between frames");
  GLOAM_TRY(device_.wait_idle());
  Context& context = device_.context();
  {
    // The display may still read the last image. Only when the whole queue is idle has presentation finished.
    const std::lock_guard lock(context.queue_mutex());
    const VkResult idle = context.vk.vkQueueWaitIdle(context.queue);
    if (idle != VK_SUCCESS) return failure("The window's pictures could not be waited for", idle);
  }
  if (acquired_ != kNone && fate_ == FrameFate::failed) GLOAM_TRY(replace_ready());
  forget_images();
  stale_ = true;
  if (width == 0 || height == 0) return {};

  VkSurfaceCapabilitiesKHR capabilities;
  const VkResult result = context.instance_functions().vkGetPhysicalDeviceSurfaceCapabilitiesKHR(
      context.physical.handle, surface_, &capabilities);
  if (result != VK_SUCCESS) return failure("The window could not be asked for its size", result);
  VkExtent2D extent = capabilities.currentExtent;
  if (extent.width == ~0u) {
    extent = {std::clamp(width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
              std::clamp(height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
  }
  if (extent.width == 0 || extent.height == 0) return {};
  GLOAM_TRY(make_swapchain(capabilities, extent));
  GLOAM_TRY(adopt_images(extent));
  stale_ = false;
  return {};
}

Status VulkanSwapchain::make_swapchain(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent) {
  Context& context = device_.context();
  const std::uint32_t most = capabilities.maxImageCount == 0 ? ~0u : capabilities.maxImageCount;
  const VkSwapchainCreateInfoKHR info = {
      .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
      .surface = surface_,
      .minImageCount = std::min(capabilities.minImageCount + 1, most),
      .imageFormat = format_.format,
      .imageColorSpace = format_.colorSpace,
      .imageExtent = extent,
      .imageArrayLayers = 1,
      .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
      .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
      .preTransform = capabilities.currentTransform,
      .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
      .presentMode = VK_PRESENT_MODE_FIFO_KHR,
      .clipped = VK_TRUE,
      .oldSwapchain = swapchain_};
  VkSwapchainKHR made = VK_NULL_HANDLE;
  const VkResult result = context.vk.vkCreateSwapchainKHR(context.device, &info, context.allocation, &made);
  context.vk.vkDestroySwapchainKHR(context.device, swapchain_, context.allocation);
  swapchain_ = result == VK_SUCCESS ? made : VK_NULL_HANDLE;
  if (result != VK_SUCCESS) return failure("The window's pictures could not be made", result);
  context.set_name(VK_OBJECT_TYPE_SWAPCHAIN_KHR, swapchain_, "window");
  return {};
}

Status VulkanSwapchain::adopt_images(VkExtent2D extent) {
  Context& context = device_.context();
  std::vector<VkImage> images;
  const VkResult result = list_all(images, [&](std::uint32_t* count, VkImage* items) {
    return context.vk.vkGetSwapchainImagesKHR(context.device, swapchain_, count, items);
  });
  if (result != VK_SUCCESS) return failure("The window's pictures could not be listed", result);
  for (VkImage image : images) {
    const ImageDesc desc = {.name = "window picture " + std::to_string(images_.size()),
                            .module = "engine",
                            .format = from_vulkan(format_.format),
                            .width = extent.width,
                            .height = extent.height,
                            .usage = ImageUsage::color_target | ImageUsage::transfer_target};
    context.set_name(VK_OBJECT_TYPE_IMAGE, image, desc.name);
    images_.push_back(device_.images().adopt(desc, image));
    const Result<VkSemaphore> semaphore = make_semaphore(desc.name + " rendered");
    if (!semaphore) return semaphore.error();
    rendered_.push_back(*semaphore);
  }
  return {};
}

void VulkanSwapchain::forget_images() {
  Context& context = device_.context();
  for (const ImageHandle image : images_) device_.destroy(image);
  for (VkSemaphore semaphore : rendered_) context.vk.vkDestroySemaphore(context.device, semaphore, context.allocation);
  images_.clear();
  rendered_.clear();
  acquired_ = kNone;
}

/// The frame waits for this semaphore before it draws to the acquired picture.
ImageHandle VulkanSwapchain::use_acquired(VkSemaphore ready) {
  Frames& frames = device_.frames();
  ready_ = ready;
  frames.tell_fate(fate_);
  frames.wait_for(ready);
  frames.signal(rendered_[acquired_]);
  return images_[acquired_];
}

Result<ImageHandle> VulkanSwapchain::acquire() {
  Frames& frames = device_.frames();
  GLOAM_ASSERT(frames.recording(), "a picture is acquired while a frame is recorded");
  if (acquired_ != kNone) {
    GLOAM_ASSERT(fate_ != FrameFate::recorded, "a picture is acquired once in a frame");
    GLOAM_ASSERT(fate_ != FrameFate::submitted, "a picture is presented before the next one is acquired");
    // A frame that was abandoned has signalled that the picture is drawn. One that failed has waited for nothing.
    return use_acquired(fate_ == FrameFate::failed ? ready_ : rendered_[acquired_]);
  }
  if (stale_) return ImageHandle();
  Context& context = device_.context();
  const VkSemaphore available = available_[frames.number() % available_.size()];
  std::uint32_t index = 0;
  const VkResult result =
      context.vk.vkAcquireNextImageKHR(context.device, swapchain_, UINT64_MAX, available, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    stale_ = true;
    return ImageHandle();
  }
  if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR) return failure("The window gave no picture", result);
  acquired_ = index;
  return use_acquired(available);
}

Status VulkanSwapchain::present() {
  if (acquired_ == kNone || fate_ == FrameFate::failed) return {};
  Context& context = device_.context();
  const VkPresentInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                 .waitSemaphoreCount = 1,
                                 .pWaitSemaphores = &rendered_[acquired_],
                                 .swapchainCount = 1,
                                 .pSwapchains = &swapchain_,
                                 .pImageIndices = &acquired_};
  VkResult result = VK_SUCCESS;
  {
    const std::lock_guard lock(context.queue_mutex());
    result = context.vk.vkQueuePresentKHR(context.queue, &info);
  }
  acquired_ = kNone;
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
    stale_ = true;
    return {};
  }
  if (result == VK_SUCCESS) return {};
  // The picture may still wait to be shown, and its semaphore may be signalled: neither can be used again.
  stale_ = true;
  return failure("The picture could not be shown", result);
}

VulkanSwapchain::~VulkanSwapchain() {
  Context& context = device_.context();
  device_.frames().drop_fate(fate_);
  device_.frames().wait_at_end();
  if (context.vk.vkDeviceWaitIdle(context.device) != VK_SUCCESS) {
    const std::lock_guard lock(context.queue_mutex());
    context.vk.vkQueueWaitIdle(context.queue);
  }
  forget_images();
  for (VkSemaphore semaphore : available_) context.vk.vkDestroySemaphore(context.device, semaphore, context.allocation);
  context.vk.vkDestroySwapchainKHR(context.device, swapchain_, context.allocation);
  context.instance_functions().vkDestroySurfaceKHR(context.instance(), surface_, nullptr);
}

}  // namespace vulkan

Result<std::unique_ptr<Swapchain>> create_swapchain(
    Device& device, const std::function<std::uint64_t(void* instance)>& create_surface) {
  auto* vulkan_device = dynamic_cast<vulkan::VulkanDevice*>(&device);
  GLOAM_ASSERT(vulkan_device != nullptr, "a swapchain needs a device made by create_vulkan_device");
  vulkan::Context& context = vulkan_device->context();
  GLOAM_ASSERT(context.physical.can_present, "a swapchain needs a device made with the window's extensions");
  const std::uint64_t surface = create_surface(context.instance());
  if (surface == 0) return Error{ErrorKind::failed, "The window system gave no surface to draw into"};
  return vulkan::VulkanSwapchain::create(*vulkan_device, (VkSurfaceKHR)surface);
}

}  // namespace gloam::gpu
