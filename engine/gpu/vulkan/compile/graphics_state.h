// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/api.h"

namespace gloam::gpu::vulkan {

/// The fixed-function state of a graphics pipeline: triangle lists, one sample, dynamic viewport and scissor.
class GraphicsState {
 public:
  explicit GraphicsState(const GraphicsPipelineDesc& desc);
  GraphicsState(const GraphicsState&) = delete;
  GraphicsState& operator=(const GraphicsState&) = delete;

  /// The result points into this object. The caller sets the stages and the layout.
  [[nodiscard]] VkGraphicsPipelineCreateInfo info() const;
  /// Whether some targets are blended and others are not.
  [[nodiscard]] bool blends_differ() const;

 private:
  void set_vertex_input(const GraphicsPipelineDesc& desc);
  void set_targets(const GraphicsPipelineDesc& desc);
  void set_dynamic(const GraphicsPipelineDesc& desc);

  std::vector<VkVertexInputBindingDescription> streams_;
  std::vector<VkVertexInputAttributeDescription> attributes_;
  std::vector<VkPipelineColorBlendAttachmentState> blends_;
  std::vector<VkFormat> color_formats_;
  std::vector<VkDynamicState> dynamic_states_;
  VkPipelineVertexInputStateCreateInfo vertex_input_ = {};
  VkPipelineInputAssemblyStateCreateInfo assembly_ = {};
  VkPipelineViewportStateCreateInfo viewport_ = {};
  VkPipelineRasterizationStateCreateInfo rasterization_ = {};
  VkPipelineMultisampleStateCreateInfo multisample_ = {};
  VkPipelineDepthStencilStateCreateInfo depth_ = {};
  VkPipelineColorBlendStateCreateInfo blend_ = {};
  VkPipelineDynamicStateCreateInfo dynamic_ = {};
  VkPipelineRenderingCreateInfo rendering_ = {};
};

}  // namespace gloam::gpu::vulkan
