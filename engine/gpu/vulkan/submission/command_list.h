// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gpu/command_list.h"
#include "engine/gpu/vulkan/binding/descriptor_writer.h"
#include "engine/gpu/vulkan/binding/frame_sets.h"
#include "engine/gpu/vulkan/binding/resource_sets.h"
#include "engine/gpu/vulkan/compile/pipelines.h"
#include "engine/gpu/vulkan/resources/buffers.h"
#include "engine/gpu/vulkan/resources/images.h"
#include "engine/gpu/vulkan/startup/context.h"
#include "engine/gpu/vulkan/submission/bound_state.h"
#include "engine/gpu/vulkan/submission/frames.h"

namespace gloam::gpu::vulkan {

/// Records into the command buffer of the current frame.
class VulkanCommandList final : public CommandList {
 public:
  VulkanCommandList(Context& context, const Buffers& buffers, Images& images, const Pipelines& pipelines,
                    const ResourceSets& sets, const DescriptorWriter& writer, FrameSets& frame_sets, Frames& frames)
      : context_(context),
        buffers_(buffers),
        images_(images),
        pipelines_(pipelines),
        sets_(sets),
        writer_(writer),
        frame_sets_(frame_sets),
        frames_(frames) {}

  void start(VkCommandBuffer commands);
  /// Undoes Image::access of this frame's barriers: the frame's commands are dropped.
  void forget_barriers();
  /// Whether the last command came between begin_rendering and end_rendering.
  [[nodiscard]] bool rendering() const { return bound_.rendering(); }
  /// Whether the host is recording (native_commands).
  [[nodiscard]] bool native() const { return bound_.native(); }
  /// The first error of this frame's recording, if any.
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

  void begin_label(std::string_view name) override;
  void end_label() override;
  void write_timestamp(std::uint32_t index) override;
  void barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) override;

  void copy_buffer(BufferHandle source, std::uint64_t source_offset, BufferHandle target, std::uint64_t target_offset,
                   std::uint64_t size) override;
  void copy_buffer_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target, std::uint32_t mip,
                            std::uint32_t first_layer, std::uint32_t layer_count) override;
  void copy_rows_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target, std::uint32_t mip,
                          std::uint32_t first_row, std::uint32_t row_count) override;
  void copy_image_to_buffer(ImageHandle source, std::uint32_t mip, std::uint32_t layer, BufferHandle target,
                            std::uint64_t target_offset) override;
  void fill_buffer(BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) override;
  void clear_color_image(ImageHandle image, std::array<std::uint32_t, 4> bits, ImageRange range) override;
  void blit(ImageHandle source, ImageHandle target, ImagePart from, ImagePart to) override;

  void begin_rendering(const RenderingDesc& desc) override;
  void end_rendering() override;
  void set_viewport(float x, float y, float width, float height) override;
  void set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) override;
  void set_depth_bias(float constant, float slope) override;

  void bind_pipeline(PipelineHandle pipeline) override;
  void bind(std::span<const Binding> bindings) override;
  void bind_set(std::uint32_t set, ResourceSetHandle resources) override;
  void push_constants(std::span<const std::byte> bytes) override;

  void bind_vertex_stream(std::uint32_t stream, BufferHandle buffer, std::uint64_t offset) override;
  void bind_indices(BufferHandle buffer, std::uint64_t offset) override;
  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
            std::uint32_t first_instance) override;
  void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                    std::int32_t vertex_offset, std::uint32_t first_instance) override;
  void draw_indirect(BufferHandle buffer, std::uint64_t offset) override;
  void draw_indexed_indirect(BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) override;
  void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) override;
  void dispatch_indirect(BufferHandle buffer, std::uint64_t offset) override;
  void* begin_native(std::optional<std::uint64_t> revision) override;
  void end_native() override;

 private:
  void check_range(BufferHandle buffer, std::uint64_t offset, std::uint64_t size) const;
  [[nodiscard]] const Pipeline& bound_pipeline() const;
  /// The attachment of a view. Lowers `layers` to the view's layer count. If the view cannot be created, records the
  /// error and returns nullopt.
  [[nodiscard]] std::optional<VkRenderingAttachmentInfo> attachment(const ImageView& view, VkImageLayout layout,
                                                                    std::uint32_t& layers);
  void fail(const Error& error);

  Context& context_;
  const Buffers& buffers_;
  Images& images_;
  const Pipelines& pipelines_;
  const ResourceSets& sets_;
  DescriptorWriter writer_;
  FrameSets& frame_sets_;
  Frames& frames_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  PipelineHandle pipeline_;
  BoundState bound_;
  VkViewport viewport_ = {};  ///< as set last, like scissor_
  VkRect2D scissor_ = {};
  /// After it, no draws and dispatches are recorded: what they need may be missing, and the frame is dropped.
  std::optional<Error> fault_;
  bool has_begun_rendering_ = false;  ///< false between begin_rendering and end_rendering if the former has failed
  /// Image::access before each image barrier of the frame, in order.
  std::vector<std::pair<ImageHandle, Subresources<Access>>> earlier_accesses_;
  std::vector<VkBufferMemoryBarrier2> buffer_barriers_;
  std::vector<VkImageMemoryBarrier2> image_barriers_;
};

}  // namespace gloam::gpu::vulkan
