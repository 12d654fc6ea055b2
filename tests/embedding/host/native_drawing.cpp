// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "engine/render/draws/caster_source.h"
#include "native_casters.h"
#include "shaders/native/shaders.h"

namespace host {
namespace {

namespace gpu = gloam::gpu;

void require(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "the host failed: %s: VkResult %d\n", what, static_cast<int>(result));
  std::exit(1);
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

VkMemoryBarrier2 barrier(gpu::Access before, gpu::Access after) {
  const gpu::HostBufferAccess from = gpu::host_buffer_access(before), to = gpu::host_buffer_access(after);
  return {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
          .srcStageMask = from.stages,
          .srcAccessMask = from.access,
          .dstStageMask = to.stages,
          .dstAccessMask = to.access};
}

void record(VkCommandBuffer commands, const VkMemoryBarrier2& barrier) {
  const VkDependencyInfo dependency = {
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

}  // namespace

NativeDrawing::NativeDrawing(VulkanHost& vulkan, gpu::Device& device, const SkinnedMesh& mesh, const Cubes& cubes)
    : vulkan_(vulkan),
      device_(device),
      vertices_(static_cast<std::uint32_t>(mesh.rest.size())),
      indices_(static_cast<std::uint32_t>(mesh.indices.size())),
      cubes_(static_cast<std::uint32_t>(cubes.size())) {
  constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  rest_buffer_ = vulkan.create_buffer(kStorage, bytes_of(mesh.rest));
  bones_buffer_ =
      vulkan.create_buffer(kStorage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, std::as_bytes(std::span(mesh.bones)));
  posed_buffer_ = vulkan.create_buffer(kStorage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, bytes_of(mesh.posed()));
  index_buffer_ = vulkan.create_buffer(VK_BUFFER_USAGE_INDEX_BUFFER_BIT, bytes_of(mesh.indices));
  cube_buffer_ = vulkan.create_buffer(VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, bytes_of(cubes));
  posed_handle_ = gpu::import_buffer(device, posed_buffer_.buffer,
                                     {.name = "posed",
                                      .module = "native_casters",
                                      .size = posed_buffer_.size,
                                      .usage = gpu::BufferUsage::storage | gpu::BufferUsage::vertex});
  make_layouts();
  make_descriptors();
  skinning_ = make_skinning();
  mesh_pipeline_ = make_caster(gloam::shaders::native::skinned_vert, VK_FORMAT_R32G32B32_SFLOAT, sizeof(gloam::vec3),
                               VK_VERTEX_INPUT_RATE_VERTEX);
  cube_pipeline_ = make_caster(gloam::shaders::native::instance_vert, VK_FORMAT_R32G32B32A32_SFLOAT,
                               sizeof(gloam::vec4), VK_VERTEX_INPUT_RATE_INSTANCE);
}

NativeDrawing::~NativeDrawing() {
  device_.destroy(posed_handle_);
  const VkDevice device = vulkan_.device();
  for (VkPipeline pipeline : {skinning_, mesh_pipeline_, cube_pipeline_}) vkDestroyPipeline(device, pipeline, nullptr);
  for (VkPipelineLayout layout : {skinning_layout_, caster_layout_}) vkDestroyPipelineLayout(device, layout, nullptr);
  vkDestroyDescriptorPool(device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(device, set_layout_, nullptr);
  for (const HostBuffer& buffer : {rest_buffer_, bones_buffer_, posed_buffer_, index_buffer_, cube_buffer_})
    vulkan_.destroy(buffer);
}

void NativeDrawing::make_layouts() {
  VkDescriptorSetLayoutBinding bindings[3] = {};
  for (std::uint32_t i = 0; i < 3; ++i)
    bindings[i] = {.binding = i,
                   .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                   .descriptorCount = 1,
                   .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
  const VkDescriptorSetLayoutCreateInfo set = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 3, .pBindings = bindings};
  require(vkCreateDescriptorSetLayout(vulkan_.device(), &set, nullptr, &set_layout_), "vkCreateDescriptorSetLayout");
  VkPipelineLayoutCreateInfo layout = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &set_layout_};
  require(vkCreatePipelineLayout(vulkan_.device(), &layout, nullptr, &skinning_layout_), "vkCreatePipelineLayout");
  const VkPushConstantRange constants = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(gloam::shaders::CasterConstants)};
  layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
            .pushConstantRangeCount = 1,
            .pPushConstantRanges = &constants};
  require(vkCreatePipelineLayout(vulkan_.device(), &layout, nullptr, &caster_layout_), "vkCreatePipelineLayout");
}

void NativeDrawing::make_descriptors() {
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3};
  const VkDescriptorPoolCreateInfo pool = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = 1, .poolSizeCount = 1, .pPoolSizes = &size};
  require(vkCreateDescriptorPool(vulkan_.device(), &pool, nullptr, &pool_), "vkCreateDescriptorPool");
  const VkDescriptorSetAllocateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pool_,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &set_layout_};
  require(vkAllocateDescriptorSets(vulkan_.device(), &set, &set_), "vkAllocateDescriptorSets");
  VkDescriptorBufferInfo buffers[3] = {{rest_buffer_.buffer, 0, VK_WHOLE_SIZE},
                                       {bones_buffer_.buffer, 0, VK_WHOLE_SIZE},
                                       {posed_buffer_.buffer, 0, VK_WHOLE_SIZE}};
  const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                      .dstSet = set_,
                                      .descriptorCount = 3,
                                      .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                      .pBufferInfo = buffers};
  vkUpdateDescriptorSets(vulkan_.device(), 1, &write, 0, nullptr);
}

VkShaderModule NativeDrawing::make_module(const gpu::ShaderCode& code) const {
  const VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                         .codeSize = code.words.size_bytes(),
                                         .pCode = code.words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  require(vkCreateShaderModule(vulkan_.device(), &info, nullptr, &module), "vkCreateShaderModule");
  return module;
}

VkPipeline NativeDrawing::make_skinning() const {
  const VkShaderModule module = make_module(gloam::shaders::native::skin_comp);
  const VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                            .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                      .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                                                      .module = module,
                                                      .pName = "main"},
                                            .layout = skinning_layout_};
  VkPipeline pipeline = VK_NULL_HANDLE;
  require(vkCreateComputePipelines(vulkan_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateComputePipelines");
  vkDestroyShaderModule(vulkan_.device(), module, nullptr);
  return pipeline;
}

VkPipeline NativeDrawing::make_caster(const gpu::ShaderCode& code, VkFormat format, std::uint32_t stride,
                                      VkVertexInputRate rate) const {
  const VkShaderModule module = make_module(code);
  const VkPipelineShaderStageCreateInfo stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                 .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                 .module = module,
                                                 .pName = "main"};
  const VkVertexInputBindingDescription stream = {0, stride, rate};
  const VkVertexInputAttributeDescription attribute = {0, 0, format, 0};
  const VkPipelineVertexInputStateCreateInfo input = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1,
      .pVertexBindingDescriptions = &stream,
      .vertexAttributeDescriptionCount = 1,
      .pVertexAttributeDescriptions = &attribute};
  const VkPipelineInputAssemblyStateCreateInfo assembly = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .polygonMode = VK_POLYGON_MODE_FILL,
      .cullMode = VK_CULL_MODE_NONE,
      .depthBiasEnable = VK_TRUE,
      .lineWidth = 1.0f};
  const VkPipelineMultisampleStateCreateInfo samples = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineDepthStencilStateCreateInfo depth = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
      .depthTestEnable = VK_TRUE,
      .depthWriteEnable = VK_TRUE,
      .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL};  // depth is reversed
  const VkPipelineColorBlendStateCreateInfo blend = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_DEPTH_BIAS};
  const VkPipelineDynamicStateCreateInfo dynamic = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, .dynamicStateCount = 3, .pDynamicStates = states};
  const VkPipelineRenderingCreateInfo rendering = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
      .depthAttachmentFormat = gpu::native_format(gloam::kCasterDepthFormat)};
  const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                             .pNext = &rendering,
                                             .stageCount = 1,
                                             .pStages = &stage,
                                             .pVertexInputState = &input,
                                             .pInputAssemblyState = &assembly,
                                             .pViewportState = &viewport,
                                             .pRasterizationState = &raster,
                                             .pMultisampleState = &samples,
                                             .pDepthStencilState = &depth,
                                             .pColorBlendState = &blend,
                                             .pDynamicState = &dynamic,
                                             .layout = caster_layout_};
  VkPipeline pipeline = VK_NULL_HANDLE;
  require(vkCreateGraphicsPipelines(vulkan_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines");
  vkDestroyShaderModule(vulkan_.device(), module, nullptr);
  return pipeline;
}

void NativeDrawing::record_skinning(VkCommandBuffer commands, const std::array<gloam::mat4, 2>& bones) const {
  // gloam does not know the buffer of bones, so the host orders its own accesses: the last frame reads it, then it is
  // written, then this frame reads it.
  record(commands, barrier(gpu::Access::compute_read, gpu::Access::transfer_write));
  vkCmdUpdateBuffer(commands, bones_buffer_.buffer, 0, sizeof(bones), bones.data());
  record(commands, barrier(gpu::Access::transfer_write, gpu::Access::compute_read));
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, skinning_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, skinning_layout_, 0, 1, &set_, 0, nullptr);
  vkCmdDispatch(commands, (vertices_ + 63) / 64, 1, 1);
}

void NativeDrawing::begin_draw(VkCommandBuffer commands, VkPipeline pipeline, const Face& face) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vkCmdSetDepthBias(commands, face.bias_units, 0.0f, face.bias_slope);
  vkCmdPushConstants(commands, caster_layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(face.constants), &face.constants);
}

void NativeDrawing::record_mesh(VkCommandBuffer commands, const Face& face) const {
  begin_draw(commands, mesh_pipeline_, face);
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &posed_buffer_.buffer, &offset);
  vkCmdBindIndexBuffer(commands, index_buffer_.buffer, 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, indices_, 1, 0, 0, 0);
}

void NativeDrawing::record_cubes(VkCommandBuffer commands, const Face& face) const {
  begin_draw(commands, cube_pipeline_, face);
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &cube_buffer_.buffer, &offset);
  vkCmdDraw(commands, 36, cubes_, 0, 0);
}

}  // namespace host
