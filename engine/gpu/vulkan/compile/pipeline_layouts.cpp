// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/pipeline_layouts.h"

#include <algorithm>

#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

std::string place(const ReflectedBinding& b) {
  return "\"" + b.name + "\" (set " + std::to_string(b.set) + ", binding " + std::to_string(b.binding) + ")";
}

Status add_binding(ShaderInterface& shader, const std::string& who, const ReflectedBinding& binding) {
  if (binding.kind == ResourceKind::other || binding.count == 0 || binding.dimension == ImageDimension::other) {
    return Error{ErrorKind::failed, who + ": " + place(binding) + " is a resource that this engine cannot bind"};
  }
  const auto known = std::find_if(shader.bindings.begin(), shader.bindings.end(), [&](const ReflectedBinding& b) {
    return b.set == binding.set && b.binding == binding.binding;
  });
  if (known == shader.bindings.end()) {
    shader.bindings.push_back(binding);
    return {};
  }
  if (known->kind != binding.kind || known->count != binding.count) {
    return Error{ErrorKind::failed, who + ": " + place(binding) + " is a " + std::string(name_of(binding.kind)) +
                                        " in one stage and a " + std::string(name_of(known->kind)) + " in another"};
  }
  if (binding.used && !known->used) {
    *known = binding;  // take the image's shape from the stage that uses it
  }
  return {};
}

}  // namespace

std::span<const ReflectedBinding> ShaderInterface::of_set(std::uint32_t set) const {
  const auto less = [](const ReflectedBinding& a, const ReflectedBinding& b) { return a.set < b.set; };
  ReflectedBinding key;
  key.set = set;
  const auto [begin, end] = std::equal_range(bindings.begin(), bindings.end(), key, less);
  return {begin, end};
}

Result<ShaderInterface> merge_stages(const Context& context, std::string_view pipeline,
                                     std::span<const SpirvReflection> stages) {
  const std::string who = "Pipeline \"" + std::string(pipeline) + "\"";
  const PhysicalDevice& device = context.physical;
  ShaderInterface shader;
  for (const SpirvReflection& stage : stages) {
    for (const ReflectedBinding& binding : stage.bindings) GLOAM_TRY(add_binding(shader, who, binding));
    shader.push_constant_bytes = std::max(shader.push_constant_bytes, stage.push_constant_bytes);
  }
  // Vulkan requires a multiple of 4.
  shader.push_constant_bytes = (shader.push_constant_bytes + 3) & ~3u;
  std::sort(shader.bindings.begin(), shader.bindings.end(),
            [](const auto& a, const auto& b) { return std::tie(a.set, a.binding) < std::tie(b.set, b.binding); });
  if (shader.push_constant_bytes > device.limits.maxPushConstantsSize) {
    return Error{ErrorKind::failed, who + " has " + std::to_string(shader.push_constant_bytes) +
                                        " bytes of push constants, and the device allows " +
                                        std::to_string(device.limits.maxPushConstantsSize)};
  }
  if (shader.set_count() > device.limits.maxBoundDescriptorSets) {
    return Error{ErrorKind::failed, who + " uses set " + std::to_string(shader.set_count() - 1) +
                                        ", and the device allows " +
                                        std::to_string(device.limits.maxBoundDescriptorSets) + " sets"};
  }
  return shader;
}

PipelineLayouts::~PipelineLayouts() {
  for (const auto& [key, layout] : layouts_) {
    context_.vk.vkDestroyPipelineLayout(context_.device, layout.layout, context_.allocation);
  }
  for (const auto& [key, layout] : set_layouts_) {
    context_.vk.vkDestroyDescriptorSetLayout(context_.device, layout, context_.allocation);
  }
}

Result<VkDescriptorSetLayout> PipelineLayouts::set_layout(std::span<const ReflectedBinding> bindings, bool pushed) {
  SetKey key;
  key.first = pushed;
  for (const ReflectedBinding& b : bindings) key.second.emplace_back(b.binding, b.kind, b.count);
  if (const auto known = set_layouts_.find(key); known != set_layouts_.end()) return known->second;

  std::vector<VkDescriptorSetLayoutBinding> vk_bindings;
  for (const ReflectedBinding& b : bindings) {
    vk_bindings.push_back({.binding = b.binding,
                           .descriptorType = to_vulkan(b.kind),
                           .descriptorCount = b.count,
                           .stageFlags = kAllStages});
  }
  const VkDescriptorSetLayoutCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
      .flags = pushed ? static_cast<VkDescriptorSetLayoutCreateFlags>(
                            VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR)
                      : 0,
      .bindingCount = static_cast<std::uint32_t>(vk_bindings.size()),
      .pBindings = vk_bindings.data()};
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  const VkResult result = context_.vk.vkCreateDescriptorSetLayout(context_.device, &info, context_.allocation, &layout);
  if (result != VK_SUCCESS) return failure("A descriptor set layout could not be made", result);
  context_.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout,
                    "set layout of " + std::to_string(bindings.size()) + " bindings");
  set_layouts_.emplace(std::move(key), layout);
  return layout;
}

Result<const PipelineLayout*> PipelineLayouts::find_or_create(const ShaderInterface& shader) {
  const std::lock_guard lock(mutex_);
  PipelineLayout made;
  std::uint32_t resources = 0;
  for (const ReflectedBinding& binding : shader.of_set(0)) resources += binding.count;
  made.pushes_set_0 = context_.physical.push_descriptors && resources <= context_.physical.max_push_descriptors;
  for (std::uint32_t set = 0; set < shader.set_count(); ++set) {
    const Result<VkDescriptorSetLayout> layout = set_layout(shader.of_set(set), set == 0 && made.pushes_set_0);
    if (!layout) return layout.error();
    made.sets.push_back(*layout);
  }
  LayoutKey key = {made.sets, shader.push_constant_bytes};
  if (const auto known = layouts_.find(key); known != layouts_.end()) return &known->second;

  const VkPushConstantRange range = {kAllStages, 0, shader.push_constant_bytes};
  const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                           .setLayoutCount = static_cast<std::uint32_t>(made.sets.size()),
                                           .pSetLayouts = made.sets.data(),
                                           .pushConstantRangeCount = shader.push_constant_bytes > 0 ? 1u : 0u,
                                           .pPushConstantRanges = &range};
  const VkResult result = context_.vk.vkCreatePipelineLayout(context_.device, &info, context_.allocation, &made.layout);
  if (result != VK_SUCCESS) return failure("A pipeline layout could not be made", result);
  context_.set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, made.layout,
                    "pipeline layout of " + std::to_string(resources) + " resources");
  return &layouts_.emplace(std::move(key), std::move(made)).first->second;
}

}  // namespace gloam::gpu::vulkan
