// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// The kinds of resources in descriptor sets.
constexpr std::array kDescriptorKinds = {ResourceKind::uniform_buffer, ResourceKind::storage_buffer,
                                         ResourceKind::sampled_image, ResourceKind::storage_image};
/// Numbers of descriptors, in the order of kDescriptorKinds.
using DescriptorCounts = std::array<std::uint32_t, kDescriptorKinds.size()>;

[[nodiscard]] DescriptorCounts count_descriptors(std::span<const ReflectedBinding> bindings);

/// `counts`: how many descriptors of each kind the pool holds.
[[nodiscard]] VkResult create_descriptor_pool(const Context& context, VkDescriptorPoolCreateFlags flags,
                                              std::uint32_t sets, const DescriptorCounts& counts,
                                              VkDescriptorPool& pool);

}  // namespace gloam::gpu::vulkan
