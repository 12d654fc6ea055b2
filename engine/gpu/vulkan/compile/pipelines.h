// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/gpu/handle_table.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/compile/pipeline_cache.h"
#include "engine/gpu/vulkan/compile/pipeline_layouts.h"
#include "engine/gpu/vulkan/compile/retained_pipelines.h"
#include "engine/gpu/vulkan/compile/shader_stages.h"
#include "engine/gpu/vulkan/resources/graveyard.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

struct Pipeline {
  std::string name;
  std::string module;
  std::shared_ptr<const PipelineObject> object;
  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
  const PipelineLayout* layout = nullptr;
  ShaderInterface shader;
  std::uint32_t used_sets = 0;  ///< bit i: the shaders use something of set i
  std::uint32_t vertex_streams = 0;
};

/// Creates, stores and destroys pipelines. Compiles on the calling thread. Thread-safe.
class Pipelines {
 public:
  /// retained: number of compiled pipelines to keep after their destruction, see VulkanOptions::retained_pipelines.
  Pipelines(Context& context, Graveyard& graveyard, const std::string& cache_directory, std::size_t retained)
      : context_(context),
        graveyard_(graveyard),
        cache_(context, cache_directory),
        layouts_(context),
        retained_(retained) {}
  ~Pipelines();

  [[nodiscard]] Result<PipelineHandle> create(const ComputePipelineDesc& desc);
  [[nodiscard]] Result<PipelineHandle> create(const GraphicsPipelineDesc& desc);
  void destroy(PipelineHandle handle);
  [[nodiscard]] const Pipeline& get(PipelineHandle handle) const { return table_.get(handle); }
  [[nodiscard]] std::uint32_t count(std::string_view module) const;

 private:
  /// A pipeline that is being created.
  struct Prepared {
    Pipeline pipeline;  ///< without VkPipeline
    ShaderStages stages;
  };
  /// Reflects the shaders, finds the layout and creates the shader modules. Asserts that the shaders take the
  /// constants.
  template <class Desc>
  [[nodiscard]] Result<Prepared> prepare(const Desc& desc, std::span<const ShaderCode> shaders,
                                         std::span<const ShaderStage> stages);
  /// Uses the retained pipeline with this content hash. If there is none, compile(VkPipeline&) creates it.
  template <class Compile>
  [[nodiscard]] Result<PipelineHandle> finish(Pipeline pipeline, std::uint64_t content, const Compile& compile);

  Context& context_;
  Graveyard& graveyard_;
  PipelineCache cache_;
  PipelineLayouts layouts_;
  RetainedPipelines retained_;
  HandleTable<Pipeline, PipelineHandle> table_;
};

}  // namespace gloam::gpu::vulkan
