// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/shader_stages.h"

#include <string>

#include "engine/gpu/spirv/specialize.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

VkShaderStageFlagBits to_vulkan(ShaderStage stage) {
  switch (stage) {
    case ShaderStage::vertex:
      return VK_SHADER_STAGE_VERTEX_BIT;
    case ShaderStage::fragment:
      return VK_SHADER_STAGE_FRAGMENT_BIT;
    case ShaderStage::compute:
      break;
  }
  return VK_SHADER_STAGE_COMPUTE_BIT;
}

}  // namespace

ShaderStages::ShaderStages(Context& context, std::span<const SpecConstant> constants)
    : context_(context), constants_(constants) {
  for (const SpecConstant& constant : constants) {
    const auto offset = static_cast<std::uint32_t>(values_.size() * sizeof(std::uint32_t));
    entries_.push_back({constant.id, offset, sizeof(std::uint32_t)});
    values_.push_back(constant.value);
  }
  specialization_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                     values_.size() * sizeof(std::uint32_t), values_.data()};
}

ShaderStages::~ShaderStages() {
  for (const auto& info : infos_) context_.vk.vkDestroyShaderModule(context_.device, info.module, nullptr);
}

Status ShaderStages::add(const ShaderCode& code, ShaderStage stage) {
  // Disabled code is left out before the driver sees it: drivers translate all code first.
  const std::vector<std::uint32_t> specialized = spirv::specialize(code.words, constants_);
  const std::span<const std::uint32_t> words = specialized.empty() ? code.words : std::span(specialized);
  const VkShaderModuleCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = words.size_bytes(), .pCode = words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  const VkResult result = context_.vk.vkCreateShaderModule(context_.device, &info, nullptr, &module);
  if (result != VK_SUCCESS) return failure("Shader \"" + std::string(code.name) + "\" was refused", result);
  context_.set_name(VK_OBJECT_TYPE_SHADER_MODULE, module, code.name);
  infos_.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                    .stage = to_vulkan(stage),
                    .module = module,
                    .pName = "main",
                    .pSpecializationInfo = entries_.empty() ? nullptr : &specialization_});
  return {};
}

}  // namespace gloam::gpu::vulkan
