// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/spirv_reflection.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/context.h"

namespace gloam::gpu::vulkan {

/// The shader modules and specialisation constants of one pipeline while it is being compiled.
class ShaderStages {
 public:
  /// constants: must outlive this.
  ShaderStages(Context& context, std::span<const SpecConstant> constants);
  ~ShaderStages();
  ShaderStages(const ShaderStages&) = delete;
  ShaderStages& operator=(const ShaderStages&) = delete;

  [[nodiscard]] Status add(const ShaderCode& code, ShaderStage stage);
  [[nodiscard]] std::span<const VkPipelineShaderStageCreateInfo> infos() const { return infos_; }

 private:
  Context& context_;
  std::span<const SpecConstant> constants_;
  std::vector<VkSpecializationMapEntry> entries_;
  std::vector<std::uint32_t> values_;
  VkSpecializationInfo specialization_ = {};
  std::vector<VkPipelineShaderStageCreateInfo> infos_;
};

}  // namespace gloam::gpu::vulkan
