// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/graphics_state.h"

#include <algorithm>

#include "engine/core/assert.h"
#include "engine/gpu/vulkan/convert.h"

namespace gloam::gpu::vulkan {

GraphicsState::GraphicsState(const GraphicsPipelineDesc& desc) {
  assembly_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
               .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  viewport_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  // Vulkan determines the winding in framebuffer space, after the viewport flip: counter-clockwise means as seen in the
  // rendered image.
  rasterization_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
                    .polygonMode = VK_POLYGON_MODE_FILL,
                    .cullMode = to_vulkan(desc.cull),
                    .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
                    .depthBiasEnable = desc.depth_bias ? VK_TRUE : VK_FALSE,
                    .lineWidth = 1.0f};
  multisample_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                  .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const bool has_depth = desc.depth_format != Format::undefined;
  depth_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = has_depth ? VK_TRUE : VK_FALSE,
            .depthWriteEnable = has_depth && desc.depth_write ? VK_TRUE : VK_FALSE,
            .depthCompareOp = to_vulkan(desc.depth_compare)};
  set_vertex_input(desc);
  set_targets(desc);
  set_dynamic(desc);
}

void GraphicsState::set_vertex_input(const GraphicsPipelineDesc& desc) {
  for (std::uint32_t i = 0; i < desc.stream_strides.size(); ++i) {
    streams_.push_back({i, desc.stream_strides[i], VK_VERTEX_INPUT_RATE_VERTEX});
  }
  for (const VertexAttribute& a : desc.attributes) {
    GLOAM_ASSERT(a.stream < desc.stream_strides.size(), "a vertex attribute lies in a stream that has a stride");
    attributes_.push_back({a.location, a.stream, to_vulkan(a.format), a.offset});
  }
  vertex_input_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                   .vertexBindingDescriptionCount = static_cast<std::uint32_t>(streams_.size()),
                   .pVertexBindingDescriptions = streams_.data(),
                   .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes_.size()),
                   .pVertexAttributeDescriptions = attributes_.data()};
}

void GraphicsState::set_targets(const GraphicsPipelineDesc& desc) {
  for (const Format format : desc.color_formats) {
    color_formats_.push_back(to_vulkan(format));
    blends_.push_back(to_vulkan(desc.blend, format));
  }
  blend_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
            .attachmentCount = static_cast<std::uint32_t>(blends_.size()),
            .pAttachments = blends_.data()};
  rendering_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                .colorAttachmentCount = static_cast<std::uint32_t>(color_formats_.size()),
                .pColorAttachmentFormats = color_formats_.data(),
                .depthAttachmentFormat = to_vulkan(desc.depth_format)};
}

void GraphicsState::set_dynamic(const GraphicsPipelineDesc& desc) {
  dynamic_states_ = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  if (desc.depth_bias) dynamic_states_.push_back(VK_DYNAMIC_STATE_DEPTH_BIAS);
  dynamic_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
              .dynamicStateCount = static_cast<std::uint32_t>(dynamic_states_.size()),
              .pDynamicStates = dynamic_states_.data()};
}

bool GraphicsState::blends_differ() const {
  return std::any_of(blends_.begin(), blends_.end(),
                     [&](const auto& blend) { return blend.blendEnable != blends_.front().blendEnable; });
}

VkGraphicsPipelineCreateInfo GraphicsState::info() const {
  return {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
          .pNext = &rendering_,
          .pVertexInputState = &vertex_input_,
          .pInputAssemblyState = &assembly_,
          .pViewportState = &viewport_,
          .pRasterizationState = &rasterization_,
          .pMultisampleState = &multisample_,
          .pDepthStencilState = &depth_,
          .pColorBlendState = &blend_,
          .pDynamicState = &dynamic_};
}

}  // namespace gloam::gpu::vulkan
