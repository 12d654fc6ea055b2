// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/pipelines.h"

#include <array>
#include <vector>

#include "engine/gpu/pipeline_hash.h"
#include "engine/gpu/vulkan/compile/graphics_state.h"
#include "engine/gpu/vulkan/compile/shader_stages.h"
#include "engine/gpu/vulkan/errors.h"

namespace gloam::gpu::vulkan {

Pipelines::~Pipelines() { static_cast<void>(table_.remove_all()); }

namespace {

/// Asserts that the shaders take the constants.
void check_constants(std::string_view pipeline, std::span<const ShaderCode> shaders, const SpecConstants& constants,
                     std::span<const SpirvReflection> reflections) {
  std::vector<ReflectedConstant> declared;
  for (const SpirvReflection& reflection : reflections)
    declared.insert(declared.end(), reflection.constants.begin(), reflection.constants.end());
  if (const auto fault = find_fault(constants, declared)) {
    std::string names;
    for (const ShaderCode& shader : shaders) names += (names.empty() ? "'" : " and '") + std::string(shader.name) + "'";
    GLOAM_ASSERT(!fault, "pipeline '" + std::string(pipeline) + "', shader " + names + ", constant '" +
                             std::string(fault->name) + "': " + fault->clause);
  }
}

}  // namespace

template <class Desc>
Result<Pipelines::Prepared> Pipelines::prepare(const Desc& desc, std::span<const ShaderCode> shaders,
                                               std::span<const ShaderStage> stages) {
  std::vector<SpirvReflection> reflections;
  for (std::size_t i = 0; i < shaders.size(); ++i) {
    Result<SpirvReflection> reflection = reflect_spirv(shaders[i]);
    if (!reflection) return Error{ErrorKind::failed, "Pipeline \"" + desc.name + "\": " + reflection.error().message};
    GLOAM_ASSERT(reflection->stage == stages[i], "a shader is used as the stage it was written for");
    reflections.push_back(std::move(*reflection));
  }
  check_constants(desc.name, shaders, desc.constants, reflections);
  Result<ShaderInterface> shader = merge_stages(context_, desc.name, reflections);
  if (!shader) return shader.error();
  const Result<const PipelineLayout*> layout = layouts_.find_or_create(*shader);
  if (!layout) return layout.error();
  std::uint32_t used_sets = 0;
  for (const ReflectedBinding& binding : shader->bindings)
    if (binding.used) used_sets |= 1u << binding.set;
  Prepared prepared{{.name = desc.name,
                     .module = desc.module,
                     .layout = *layout,
                     .shader = std::move(*shader),
                     .used_sets = used_sets},
                    ShaderStages(context_)};
  for (std::size_t i = 0; i < shaders.size(); ++i)
    GLOAM_TRY(prepared.stages.add(shaders[i], stages[i], numbered(desc.constants, reflections[i].constants)));
  return prepared;
}

template <class Compile>
Result<PipelineHandle> Pipelines::finish(Pipeline pipeline, std::uint64_t content, const Compile& compile) {
  if (retained_.enabled()) pipeline.object = retained_.find(content);
  if (pipeline.object == nullptr) {
    VkPipeline compiled = VK_NULL_HANDLE;
    const VkResult result = compile(compiled);
    if (result != VK_SUCCESS) return failure("Pipeline \"" + pipeline.name + "\" could not be compiled", result);
    context_.set_name(VK_OBJECT_TYPE_PIPELINE, compiled, pipeline.name);
    pipeline.object = std::make_shared<const PipelineObject>(context_, compiled);
    retained_.keep(content, pipeline.object);
  }
  return table_.insert(std::move(pipeline));
}

Result<PipelineHandle> Pipelines::create(const ComputePipelineDesc& desc) {
  constexpr std::array kStages = {ShaderStage::compute};
  Result<Prepared> prepared = prepare(desc, {&desc.shader, 1}, kStages);
  if (!prepared) return prepared.error();
  const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                            .stage = prepared->stages.infos().front(),
                                            .layout = prepared->pipeline.layout->layout};
  return finish(std::move(prepared->pipeline), retained_.enabled() ? description_hash(desc, ShaderIdentity::words) : 0,
                [&](VkPipeline& compiled) {
                  return context_.vk.vkCreateComputePipelines(context_.device, cache_.handle(), 1, &info,
                                                              context_.allocation, &compiled);
                });
}

Result<PipelineHandle> Pipelines::create(const GraphicsPipelineDesc& desc) {
  constexpr std::array kStages = {ShaderStage::vertex, ShaderStage::fragment};
  const std::array shaders = {desc.vertex, desc.fragment};
  const std::size_t count = desc.fragment.words.empty() ? 1 : 2;
  if (desc.depth_format != Format::undefined && context_.physical.crashes_at_depth_tests) {
    return Error{ErrorKind::no_device,
                 context_.physical.info.name + " crashes at depth tests: set LP_NATIVE_VECTOR_WIDTH to 128 or 256"};
  }
  Result<Prepared> prepared = prepare(desc, std::span(shaders).first(count), kStages);
  if (!prepared) return prepared.error();
  prepared->pipeline.bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  prepared->pipeline.vertex_streams = static_cast<std::uint32_t>(desc.stream_strides.size());

  const GraphicsState state(desc);
  if (state.blends_differ() && context_.physical.features.core.features.independentBlend == VK_FALSE) {
    return Error{ErrorKind::no_device, "Pipeline \"" + desc.name +
                                           "\" blends some of its targets only, and the device " +
                                           context_.physical.info.name + " has no independentBlend"};
  }
  VkGraphicsPipelineCreateInfo info = state.info();
  const auto stages = prepared->stages.infos();
  info.stageCount = static_cast<std::uint32_t>(stages.size());
  info.pStages = stages.data();
  info.layout = prepared->pipeline.layout->layout;
  return finish(std::move(prepared->pipeline), retained_.enabled() ? description_hash(desc, ShaderIdentity::words) : 0,
                [&](VkPipeline& compiled) {
                  return context_.vk.vkCreateGraphicsPipelines(context_.device, cache_.handle(), 1, &info,
                                                               context_.allocation, &compiled);
                });
}

void Pipelines::destroy(PipelineHandle handle) {
  graveyard_.bury([object = table_.remove(handle).object]() mutable { object.reset(); });
}

std::uint32_t Pipelines::count(std::string_view module) const {
  std::uint32_t count = 0;
  table_.for_each([&](const Pipeline& pipeline) { count += pipeline.module == module ? 1 : 0; });
  return count;
}

}  // namespace gloam::gpu::vulkan
