// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/context.h"
#include "engine/gpu/vulkan/graveyard.h"
#include "engine/gpu/vulkan/pipeline_cache.h"
#include "engine/gpu/vulkan/pipeline_layouts.h"

namespace gloam::gpu::vulkan {

struct Pipeline {
  std::string name;
  std::string module;
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
  const PipelineLayout* layout = nullptr;
  ShaderInterface shader;
};

/// Compiles on the calling thread; thread-safe.
class Pipelines {
 public:
  Pipelines(Context& context, Graveyard& graveyard, const std::string& cache_directory)
      : context_(context), graveyard_(graveyard), cache_(context, cache_directory), layouts_(context) {}
  ~Pipelines();

  [[nodiscard]] Result<PipelineHandle> create(const ComputePipelineDesc& desc);
  [[nodiscard]] Result<PipelineHandle> create(const GraphicsPipelineDesc& desc);
  void destroy(PipelineHandle handle);
  [[nodiscard]] const Pipeline& get(PipelineHandle handle) const { return table_.get(handle); }
  [[nodiscard]] std::uint32_t count(std::string_view module) const;

 private:
  /// Reflects the stages and finds the layout; the VkPipeline is still missing.
  [[nodiscard]] Result<Pipeline> prepare(std::string_view name, std::string_view module,
                                         std::span<const ShaderCode> shaders, std::span<const ShaderStage> stages);
  [[nodiscard]] Result<PipelineHandle> finish(Pipeline pipeline, VkResult result);

  Context& context_;
  Graveyard& graveyard_;
  PipelineCache cache_;
  PipelineLayouts layouts_;
  HandleTable<Pipeline, PipelineHandle> table_;
};

}  // namespace gloam::gpu::vulkan
