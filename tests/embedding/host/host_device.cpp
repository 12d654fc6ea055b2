// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host with its own Vulkan device, images and threads. gloam draws two views into the host's images; they must equal,
// bit for bit, the images that gloam draws on its own device. Exit code 77: there is no Vulkan device.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <string>
#include <vector>

#include "checks.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"
#include "engine/jobs/executor_conformance.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "thread_executor.h"
#include "vulkan_host.h"

namespace {

namespace gpu = gloam::gpu;
using Bytes = std::vector<std::uint8_t>;

constexpr int kFrames = 3;
constexpr std::uint32_t kWidth = 200;
constexpr std::uint32_t kHeight = 120;

using host::check;
using host::fail;
using host::value_of;

/// Two views: view 0 from the front, view 1 from the side at half the resolution.
gloam::ViewSettings view_settings(std::uint32_t index) {
  gloam::ViewSettings settings;
  settings.id = gloam::ViewId{index};
  settings.width = kWidth >> index;
  settings.height = kHeight >> index;
  const gloam::dquat turn = index == 0 ? gloam::dquat(1.0, 0.0, 0.0, 0.0) : gloam::dquat(0.924, 0.0, 0.383, 0.0);
  settings.world_from_camera = gloam::dmat4(glm::mat3_cast(turn));
  settings.world_from_camera[3] =
      gloam::dvec4(index == 0 ? gloam::dvec3(0.0, 1.3, 6.0) : gloam::dvec3(4.5, 1.5, 4.0), 1.0);
  return settings;
}

gpu::ImageDesc target_desc(gpu::Format format, const gloam::ViewSettings& view, gpu::ImageUsage usage) {
  gpu::ImageDesc desc;
  desc.name = "host picture";
  desc.module = "host";
  desc.format = format;
  desc.width = view.width;
  desc.height = view.height;
  desc.usage = usage;
  return desc;
}

/// Draws with gloam on the host's device and threads into the host's images.
std::array<Bytes, 2> draw_on(host::VulkanHost& vulkan, gloam::LogSink& log) {
  gpu::HostDevice description = vulkan.describe();
  description.log = &log;
  host::ThreadExecutor executor(3);
  auto device = value_of(gpu::create_vulkan_device_on(description));
  auto renderer = value_of(gloam::Renderer::create(
      {.device = device.get(), .executor = &executor, .log = &log, .modules = gloam::make_all_modules()}));
  gloam::World world;
  renderer->prepare_world(world);
  host::build_little_world(world);

  using enum gpu::ImageUsage;
  std::array<gloam::ViewRequest, 2> views = {{{.settings = view_settings(0)}, {.settings = view_settings(1)}}};
  const host::HostImage front =
      vulkan.create_image(VK_FORMAT_R8G8B8A8_SRGB, views[0].settings.width, views[0].settings.height);
  const host::HostImage side =
      vulkan.create_image(VK_FORMAT_B8G8R8A8_UNORM, views[1].settings.width, views[1].settings.height);
  const gpu::ImageUsage usage = color_target | sampled | transfer_source;
  const gpu::ImageHandle front_handle =
      gpu::import_image(*device, front.image, target_desc(gpu::Format::rgba8_srgb, views[0].settings, usage));
  const gpu::ImageHandle side_handle =
      gpu::import_image(*device, side.image, target_desc(gpu::Format::bgra8_unorm, views[1].settings, usage));

  // Each frame waits for a semaphore of the host and signals another one when it has finished.
  const VkSemaphore may_draw = vulkan.create_timeline();
  const VkSemaphore drawn = vulkan.create_timeline();
  std::uint64_t frame = 0;
  views[0].target = {.image = front_handle, .after = gpu::Access::transfer_read};
  views[1].target.after = gpu::Access::fragment_read;
  views[1].target.acquire = [&]() -> gloam::Result<gpu::ImageHandle> {
    const gpu::HostSemaphore wait = {may_draw, frame};
    const gpu::HostSemaphore signal = {drawn, frame};
    gpu::add_frame_semaphores(*device, {&wait, 1}, {&signal, 1});
    return side_handle;
  };
  for (frame = 1; frame <= kFrames; ++frame) {
    check(renderer->render(world, views));
    vulkan.signal(may_draw, frame);
  }
  const gpu::HostSemaphore all_drawn = gpu::frame_timeline(*device);
  std::array<Bytes, 2> pictures;
  pictures[0] = vulkan.read(front, gpu::host_image_layout(gpu::Access::transfer_read), all_drawn);
  device->destroy(front_handle);
  device->destroy(side_handle);
  renderer.reset();
  device.reset();
  // gloam's objects are destroyed; the host's device, image and semaphore still exist.
  pictures[1] = vulkan.read(side, gpu::host_image_layout(gpu::Access::fragment_read), {drawn, kFrames});
  vulkan.destroy(front);
  vulkan.destroy(side);
  return pictures;
}

Bytes read_back(gpu::Device& device, gpu::ImageHandle image) {
  const gpu::ImageDesc& desc = device.desc(image);
  gpu::BufferDesc buffer_desc;
  buffer_desc.name = "readback";
  buffer_desc.module = "host";
  buffer_desc.size = std::uint64_t{desc.width} * desc.height * gpu::bytes_per_texel(desc.format);
  buffer_desc.usage = gpu::BufferUsage::transfer_target;
  buffer_desc.memory = gpu::MemoryKind::readback;
  const gpu::BufferHandle buffer = value_of(device.create_buffer(buffer_desc));
  gpu::CommandList* commands = value_of(device.begin_frame());
  commands->copy_image_to_buffer(image, 0, 0, buffer, 0);
  const gpu::BufferBarrier ready = {buffer, gpu::Access::transfer_write, gpu::Access::host_read};
  commands->barrier({&ready, 1}, {});
  check(device.submit_frame());
  check(device.wait_idle());
  const auto mapped = device.mapped(buffer);
  Bytes bytes(mapped.size());
  std::transform(mapped.begin(), mapped.end(), bytes.begin(), [](std::byte b) { return static_cast<std::uint8_t>(b); });
  return bytes;
}

/// Draws the same views on gloam's own device and threads.
std::array<Bytes, 2> draw_alone(const std::string& device_name, gloam::LogSink& log) {
  const auto executor = gloam::make_pool_executor(2);
  auto device = value_of(gpu::create_vulkan_device({.device = device_name, .log = &log}));
  auto renderer = value_of(gloam::Renderer::create(
      {.device = device.get(), .executor = executor.get(), .log = &log, .modules = gloam::make_all_modules()}));
  gloam::World world;
  renderer->prepare_world(world);
  host::build_little_world(world);
  std::array<gloam::ViewRequest, 2> views = {{{.settings = view_settings(0)}, {.settings = view_settings(1)}}};
  const gpu::ImageUsage usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
  const gpu::ImageHandle side =
      value_of(device->create_image(target_desc(gpu::Format::bgra8_unorm, views[1].settings, usage)));
  views[1].target = {.image = side, .after = gpu::Access::transfer_read};
  for (int frame = 0; frame < kFrames; ++frame) check(renderer->render(world, views));
  return {value_of(renderer->read_picture(gloam::ViewId{0})).rgba, read_back(*device, side)};
}

/// Checks that an unusable device is refused and that the error names what is missing.
void check_refusal(host::VulkanHost& vulkan) {
  gpu::HostDevice bare = vulkan.describe();
  bare.enabled_features = nullptr;
  const auto refused = gpu::create_vulkan_device_on(bare);
  if (refused.ok()) fail("a device without features was taken");
  for (const char* name : {"timelineSemaphore", "dynamicRendering", "shaderStorageImageExtendedFormats"}) {
    if (refused.error().message.find(name) == std::string::npos) fail("not named: " + refused.error().message);
  }
}

/// Checks that the host's pool keeps the rules of JobExecutor.
void check_pool() {
  host::ThreadExecutor executor(3);
  for (const std::string& fault : gloam::executor_faults(executor)) fail("the host's pool: " + fault);
}

}  // namespace

int main() {
  check_pool();
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  gloam::LogSink& log = host::warning_log();
  gpu::separate_driver_caches();
  check_refusal(*vulkan);
  const std::array<Bytes, 2> hosted = draw_on(*vulkan, log);
  const std::array<Bytes, 2> alone = draw_alone(vulkan->device_name(), log);
  for (std::size_t i = 0; i < hosted.size(); ++i) {
    if (hosted[i] != alone[i]) fail("view " + std::to_string(i) + " differs from gloam's own picture");
    const auto [low, high] = std::minmax_element(hosted[i].begin(), hosted[i].end());
    if (*high - *low < 64) fail("view " + std::to_string(i) + " shows nothing");
  }
  const bool validated = vulkan->validates();
  const std::uint64_t messages = vulkan->close();
  std::printf("gloam on a host's device (%s): 2 views equal gloam's own bit for bit; validation %s, %llu messages\n",
              vulkan->device_name().c_str(), validated ? "on" : "not installed",
              static_cast<unsigned long long>(messages));
  return messages == 0 ? 0 : 1;
}
