// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string>

#include "engine/gpu/vulkan/barriers.h"
#include "engine/gpu/vulkan/convert.h"
#include "engine/gpu/vulkan/submission/command_list.h"

// Rendering, binding, drawing and dispatching.
namespace gloam::gpu::vulkan {
namespace {

constexpr std::uint32_t kIndirectDrawBytes = sizeof(VkDrawIndexedIndirectCommand);

}  // namespace

std::optional<VkRenderingAttachmentInfo> VulkanCommandList::attachment(const ImageView& view, VkImageLayout layout,
                                                                       std::uint32_t& layers) {
  ViewKey key = resolve_view(images_.get(view.image).desc, view);
  key.mip_count = 1;
  key.type = key.layer_count > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  layers = std::min(layers, key.layer_count);
  const Result<VkImageView> vk_view = images_.view(view.image, key);
  if (!vk_view) {
    fail(vk_view.error());
    return std::nullopt;
  }
  return VkRenderingAttachmentInfo{
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, .imageView = *vk_view, .imageLayout = layout};
}

void VulkanCommandList::begin_rendering(const RenderingDesc& desc) {
  bound_.begin_rendering();
  std::uint32_t layers = std::numeric_limits<std::uint32_t>::max();
  std::vector<VkRenderingAttachmentInfo> colors;
  for (const ColorTarget& target : desc.colors) {
    auto info = attachment(target.view, facts_of(Access::color_target).layout, layers);
    if (!info) return;
    info->loadOp = to_vulkan(target.load);
    info->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    std::copy(target.clear.begin(), target.clear.end(), info->clearValue.color.float32);
    colors.push_back(*info);
  }
  std::optional<VkRenderingAttachmentInfo> depth;
  if (desc.depth.view.image) {
    const Access access = desc.depth.read_only ? Access::depth_test : Access::depth_target;
    depth = attachment(desc.depth.view, facts_of(access).layout, layers);
    if (!depth) return;
    GLOAM_ASSERT(!desc.depth.read_only || desc.depth.load == LoadOp::load, "read-only depth is loaded, never cleared");
    depth->loadOp = to_vulkan(desc.depth.load);
    // A store counts as a write, and fragments may sample the image at the same time.
    depth->storeOp = desc.depth.read_only ? VK_ATTACHMENT_STORE_OP_NONE : VK_ATTACHMENT_STORE_OP_STORE;
    depth->clearValue.depthStencil = {desc.depth.clear, 0};
  }
  const VkOffset2D corner = {static_cast<std::int32_t>(desc.x), static_cast<std::int32_t>(desc.y)};
  const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                .renderArea = {corner, {desc.width, desc.height}},
                                .layerCount = colors.empty() && !depth ? 1 : layers,
                                .colorAttachmentCount = static_cast<std::uint32_t>(colors.size()),
                                .pColorAttachments = colors.data(),
                                .pDepthAttachment = depth ? &*depth : nullptr};
  context_.vk.vkCmdBeginRendering(commands_, &info);
  has_begun_rendering_ = true;
  set_viewport(static_cast<float>(desc.x), static_cast<float>(desc.y), static_cast<float>(desc.width),
               static_cast<float>(desc.height));
  set_scissor(corner.x, corner.y, desc.width, desc.height);
}

void VulkanCommandList::end_rendering() {
  bound_.end_rendering();
  if (has_begun_rendering_) context_.vk.vkCmdEndRendering(commands_);
  has_begun_rendering_ = false;
}

void VulkanCommandList::set_viewport(float x, float y, float width, float height) {
  bound_.check_own("set_viewport");
  viewport_ = {x, y + height, width, -height, 0.0f, 1.0f};
  context_.vk.vkCmdSetViewport(commands_, 0, 1, &viewport_);
}

void VulkanCommandList::set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
  bound_.check_own("set_scissor");
  scissor_ = {{x, y}, {width, height}};
  context_.vk.vkCmdSetScissor(commands_, 0, 1, &scissor_);
}

void VulkanCommandList::set_depth_bias(float constant, float slope) {
  bound_.check_own("set_depth_bias");
  context_.vk.vkCmdSetDepthBias(commands_, constant, 0.0f, slope);
}

const Pipeline& VulkanCommandList::bound_pipeline() const {
  GLOAM_ASSERT(pipeline_, "a pipeline is bound first");
  return pipelines_.get(pipeline_);
}

void VulkanCommandList::bind_pipeline(PipelineHandle handle) {
  const Pipeline& pipeline = pipelines_.get(handle);
  bound_.bind_pipeline(pipeline);
  pipeline_ = handle;
  context_.vk.vkCmdBindPipeline(commands_, pipeline.bind_point, pipeline.object->get());
}

void VulkanCommandList::bind(std::span<const Binding> bindings) {
  const Pipeline& pipeline = bound_pipeline();
  bound_.bind_set(0);  // also if it fails: the frame's draws and dispatches are then not recorded
  VkDescriptorSet set = VK_NULL_HANDLE;
  if (!pipeline.layout->pushes_set_0 && !pipeline.shader.of_set(0).empty()) {
    const Result<VkDescriptorSet> allocated = frame_sets_.allocate(pipeline.layout->sets[0], pipeline.shader.of_set(0));
    if (!allocated) return fail(allocated.error());
    set = *allocated;
  }
  const auto writes = writer_.build(pipeline, 0, bindings, set, DescriptorWriter::Layouts::as_recorded);
  if (!writes) return fail(writes.error());
  if (writes->empty()) return;
  if (set != VK_NULL_HANDLE) {
    context_.vk.vkUpdateDescriptorSets(context_.device, static_cast<std::uint32_t>(writes->size()), writes->data(), 0,
                                       nullptr);
    context_.vk.vkCmdBindDescriptorSets(commands_, pipeline.bind_point, pipeline.layout->layout, 0, 1, &set, 0,
                                        nullptr);
    return;
  }
  context_.vk.vkCmdPushDescriptorSetKHR(commands_, pipeline.bind_point, pipeline.layout->layout, 0,
                                        static_cast<std::uint32_t>(writes->size()), writes->data());
}

void VulkanCommandList::bind_set(std::uint32_t set, ResourceSetHandle resources) {
  const Pipeline& pipeline = bound_pipeline();
  GLOAM_ASSERT(set >= 1 && set < pipeline.layout->sets.size(),
               "pipeline \"" + pipeline.name + "\" has no prepared set " + std::to_string(set));
  const VkDescriptorSet vk_set = sets_.get(resources);
  bound_.bind_set(set);
  context_.vk.vkCmdBindDescriptorSets(commands_, pipeline.bind_point, pipeline.layout->layout, set, 1, &vk_set, 0,
                                      nullptr);
}

void VulkanCommandList::push_constants(std::span<const std::byte> bytes) {
  const Pipeline& pipeline = bound_pipeline();
  const std::uint32_t size = pipeline.shader.push_constant_bytes;
  // C++ may pad the end of a structure, so `bytes` may be longer; exactly the bytes that the shader declares are
  // pushed.
  GLOAM_ASSERT(bytes.size() >= size, "pipeline \"" + pipeline.name + "\" wants " + std::to_string(size) +
                                         " bytes of push constants, and was given " + std::to_string(bytes.size()));
  if (size == 0) return;
  context_.vk.vkCmdPushConstants(commands_, pipeline.layout->layout, kAllStages, 0, size, bytes.data());
}

void VulkanCommandList::bind_vertex_stream(std::uint32_t stream, BufferHandle buffer, std::uint64_t offset) {
  check_range(buffer, offset, 0);
  const VkBuffer vk_buffer = buffers_.get(buffer).buffer;
  const VkDeviceSize vk_offset = offset;
  bound_.bind_vertex_stream(stream);
  context_.vk.vkCmdBindVertexBuffers(commands_, stream, 1, &vk_buffer, &vk_offset);
}

void VulkanCommandList::bind_indices(BufferHandle buffer, std::uint64_t offset) {
  check_range(buffer, offset, 0);
  bound_.bind_indices();
  context_.vk.vkCmdBindIndexBuffer(commands_, buffers_.get(buffer).buffer, offset, VK_INDEX_TYPE_UINT32);
}

void VulkanCommandList::draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
                             std::uint32_t first_instance) {
  bound_.check_draw(pipelines_, pipeline_, false);
  if (fault_) return;
  context_.vk.vkCmdDraw(commands_, vertices, instances, first_vertex, first_instance);
}

void VulkanCommandList::draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                                     std::int32_t vertex_offset, std::uint32_t first_instance) {
  bound_.check_draw(pipelines_, pipeline_, true);
  if (fault_) return;
  context_.vk.vkCmdDrawIndexed(commands_, indices, instances, first_index, vertex_offset, first_instance);
}

void VulkanCommandList::draw_indirect(BufferHandle buffer, std::uint64_t offset) {
  bound_.check_draw(pipelines_, pipeline_, false);
  check_range(buffer, offset, sizeof(VkDrawIndirectCommand));
  if (fault_) return;
  context_.vk.vkCmdDrawIndirect(commands_, buffers_.get(buffer).buffer, offset, 1, 0);
}

void VulkanCommandList::draw_indexed_indirect(BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) {
  bound_.check_draw(pipelines_, pipeline_, true);
  check_range(buffer, offset, std::uint64_t{draw_count} * kIndirectDrawBytes);
  if (fault_) return;
  const PhysicalDevice& device = context_.physical;
  const bool many = device.features.core.features.multiDrawIndirect == VK_TRUE;
  const std::uint32_t most = many ? device.limits.maxDrawIndirectCount : 1;
  while (draw_count > 0) {
    const std::uint32_t count = std::min(draw_count, most);
    context_.vk.vkCmdDrawIndexedIndirect(commands_, buffers_.get(buffer).buffer, offset, count, kIndirectDrawBytes);
    offset += std::uint64_t{count} * kIndirectDrawBytes;
    draw_count -= count;
  }
}

void VulkanCommandList::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  bound_.check_dispatch(pipelines_, pipeline_);
  if (fault_) return;
  context_.vk.vkCmdDispatch(commands_, x, y, z);
}

void VulkanCommandList::dispatch_indirect(BufferHandle buffer, std::uint64_t offset) {
  bound_.check_dispatch(pipelines_, pipeline_);
  check_range(buffer, offset, sizeof(VkDispatchIndirectCommand));
  if (fault_) return;
  context_.vk.vkCmdDispatchIndirect(commands_, buffers_.get(buffer).buffer, offset);
}

void* VulkanCommandList::begin_native(std::optional<std::uint64_t>) {
  GLOAM_ASSERT(frames_.recording(), "native commands are recorded between begin_frame and submit_frame");
  bound_.begin_native();
  pipeline_ = {};
  return fault_ ? VK_NULL_HANDLE : commands_;
}

void VulkanCommandList::end_native() {
  bound_.end_native();
  if (!has_begun_rendering_) return;  // begin_rendering sets both
  context_.vk.vkCmdSetViewport(commands_, 0, 1, &viewport_);
  context_.vk.vkCmdSetScissor(commands_, 0, 1, &scissor_);
}

}  // namespace gloam::gpu::vulkan
