// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// The shader modules and specialisation constants of one pipeline while it is being compiled.
class ShaderStages {
 public:
  explicit ShaderStages(Context& context) : context_(&context) {}
  ~ShaderStages();
  ShaderStages(ShaderStages&& other) noexcept;
  ShaderStages& operator=(ShaderStages&&) = delete;

  [[nodiscard]] Status add(const ShaderCode& code, ShaderStage stage, std::span<const NumberedConstant> constants);
  /// Valid until this is moved or another stage is added.
  [[nodiscard]] std::span<const VkPipelineShaderStageCreateInfo> infos();

 private:
  struct Stage {
    VkShaderModule module = VK_NULL_HANDLE;
    ShaderStage stage = ShaderStage::compute;
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    VkSpecializationInfo specialization = {};
  };
  Context* context_;
  std::vector<Stage> stages_;
  std::vector<VkPipelineShaderStageCreateInfo> infos_;
};

}  // namespace gloam::gpu::vulkan
