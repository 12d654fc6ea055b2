// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/shader_stages.h"

#include <string>
#include <utility>

#include "engine/gpu/spirv/runtime_conditions.h"
#include "engine/gpu/spirv/specialize.h"
#include "engine/gpu/spirv/split_selections.h"
#include "engine/gpu/vulkan/compile/path_walk.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {
namespace {

VkShaderStageFlagBits stage_bit(ShaderStage stage) {
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

bool splits_selections(Context& context) {
  return context.physical.split_selections ? *context.physical.split_selections : walks_all_paths(context);
}

}  // namespace

ShaderStages::ShaderStages(ShaderStages&& other) noexcept
    : context_(other.context_), stages_(std::exchange(other.stages_, {})) {}

ShaderStages::~ShaderStages() {
  for (const Stage& stage : stages_)
    context_->vk.vkDestroyShaderModule(context_->device, stage.module, context_->allocation);
}

Status ShaderStages::add(const ShaderCode& code, ShaderStage stage, std::span<const NumberedConstant> constants) {
  // Disabled code is left out before the driver sees it: drivers translate all code first.
  const std::vector<std::uint32_t> specialized = spirv::specialize(code.words, constants);
  std::span<const std::uint32_t> words = specialized.empty() ? code.words : std::span(specialized);
  std::vector<std::uint32_t> hidden;
  if (context_->physical.compiles_for_uniforms) hidden = spirv::hide_uniform_conditions(words);
  if (!hidden.empty()) words = hidden;
  std::vector<std::uint32_t> split;
  if (spirv::count_selections(words) > kMostSelections && splits_selections(*context_)) {
    split = spirv::split_selections(words);
    if (!split.empty()) words = split;
    if (const std::uint64_t left = spirv::count_selections(words); left > kMostSelections) {
      return Error{ErrorKind::no_device, "The compiler of " + context_->physical.info.name +
                                             " does not end at shader \"" + std::string(code.name) + "\", which has " +
                                             std::to_string(left) + " branches: use another device"};
    }
  }
  const VkShaderModuleCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = words.size_bytes(), .pCode = words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  const VkResult result = context_->vk.vkCreateShaderModule(context_->device, &info, context_->allocation, &module);
  if (result != VK_SUCCESS) return failure("Shader \"" + std::string(code.name) + "\" was refused", result);
  context_->set_name(VK_OBJECT_TYPE_SHADER_MODULE, module, code.name);
  Stage& added = stages_.emplace_back();
  added.module = module;
  added.stage = stage;
  for (const NumberedConstant& constant : constants) {
    const auto offset = static_cast<std::uint32_t>(added.values.size() * sizeof(std::uint32_t));
    added.entries.push_back({constant.id, offset, sizeof(std::uint32_t)});
    added.values.push_back(constant.value);
  }
  return {};
}

std::span<const VkPipelineShaderStageCreateInfo> ShaderStages::infos() {
  infos_.clear();
  for (Stage& stage : stages_) {
    stage.specialization = {static_cast<std::uint32_t>(stage.entries.size()), stage.entries.data(),
                            stage.values.size() * sizeof(std::uint32_t), stage.values.data()};
    infos_.push_back({.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                      .stage = stage_bit(stage.stage),
                      .module = stage.module,
                      .pName = "main",
                      .pSpecializationInfo = stage.entries.empty() ? nullptr : &stage.specialization});
  }
  return infos_;
}

}  // namespace gloam::gpu::vulkan
