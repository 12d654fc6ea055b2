// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/vulkan/device.h"
#include "engine/gpu/vulkan/startup/features.h"
#include "engine/gpu/vulkan/startup/functions.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// Describes a device of create_vulkan_device as one of a host, so that a second gpu::Device can be created on its
/// handles. features: filled here; must live until that device is created.
[[nodiscard]] inline gpu::HostDevice lend(gpu::Device& device, gpu::vulkan::Features& features) {
  gpu::vulkan::Context& context = dynamic_cast<gpu::vulkan::VulkanDevice&>(device).context();
  features = gpu::vulkan::features_to_enable(context.physical.features);
  gpu::HostDevice host;
  host.instance = context.instance();
  host.physical_device = context.physical.handle;
  host.device = context.device;
  host.queue = context.queue;
  host.queue_family = context.physical.queue_family;
  host.get_instance_proc_addr = gpu::vulkan::find_loader();
  if (context.physical.push_descriptors) host.enabled_extensions = gpu::useful_device_extensions();
  host.enabled_features = features.chain();
  host.queue_mutex = &context.queue_mutex();
  host.log = &gpu_log();
  return host;
}

}  // namespace gloam::test
