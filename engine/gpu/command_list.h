// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "engine/gpu/types.h"

namespace gloam::gpu {

/// Records the GPU commands of one frame, in order. Valid from Device::begin_frame to Device::submit_frame, on one
/// thread only.
class CommandList {
 public:
  virtual ~CommandList() = default;

  /// Labels name groups of commands for debugging tools and may nest.
  virtual void begin_label(std::string_view name) = 0;
  virtual void end_label() = 0;
  /// Writes the device clock, in nanoseconds, when all earlier work has finished. index: < Device::kTimestampsPerFrame;
  /// each index at most once per frame.
  virtual void write_timestamp(std::uint32_t index) = 0;

  /// Barriers, copies, fills, clears, blits and dispatches are not allowed between begin_rendering and end_rendering.
  virtual void barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) = 0;

  /// Offsets and size in bytes, size > 0. The two buffers must differ.
  virtual void copy_buffer(BufferHandle source, std::uint64_t source_offset, BufferHandle target,
                           std::uint64_t target_offset, std::uint64_t size) = 0;
  /// Copies tightly packed texels to one mip of the layers [first_layer, first_layer + layer_count), layer after layer.
  /// A volume has one layer, with one slice after the other. source_offset: bytes.
  virtual void copy_buffer_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                    std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) = 0;
  /// Copies tightly packed texels to some rows of one mip of a 2D colour image with one layer. source_offset: bytes, a
  /// multiple of 4 and of a texel's bytes.
  virtual void copy_rows_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                  std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) = 0;
  /// Copies one mip of one layer to tightly packed texels. target_offset: bytes.
  virtual void copy_image_to_buffer(ImageHandle source, std::uint32_t mip, std::uint32_t layer, BufferHandle target,
                                    std::uint64_t target_offset) = 0;
  /// Fills a range with copies of `word`. offset and size: bytes, multiples of 4, size > 0.
  virtual void fill_buffer(BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) = 0;
  /// Sets mips and layers of a colour image, which must be ready for transfer_write. bits: the four channels as bits of
  /// a float, or as an integer for integer formats.
  virtual void clear_color_image(ImageHandle image, std::array<std::uint32_t, 4> bits, ImageRange range = {}) = 0;
  /// Copies one mip of one layer of a colour image to another, scaled with a linear filter. `from` must be ready for
  /// transfer_read, `to` for transfer_write. Both are volumes, or neither is. source and target may be one image if the
  /// two parts differ.
  virtual void blit(ImageHandle source, ImageHandle target, ImagePart from = {}, ImagePart to = {}) = 0;

  virtual void begin_rendering(const RenderingDesc& desc) = 0;
  virtual void end_rendering() = 0;
  /// In pixels from the top left corner. The viewport is flipped vertically, so that clip space has Y up.
  virtual void set_viewport(float x, float y, float width, float height) = 0;
  virtual void set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) = 0;
  /// For pipelines with depth_bias. constant: in units of the smallest resolvable depth difference; slope: factor of
  /// the polygon's greatest depth slope (both as in vkCmdSetDepthBias).
  virtual void set_depth_bias(float constant, float slope) = 0;

  virtual void bind_pipeline(PipelineHandle pipeline) = 0;
  /// Binds the resources of set 0 of the bound pipeline. Every binding that the shader uses must be given.
  virtual void bind(std::span<const Binding> bindings) = 0;
  /// Binds a prepared resource set. set: ≥ 1.
  virtual void bind_set(std::uint32_t set, ResourceSetHandle resources) = 0;
  /// For the bound pipeline. bytes: at least as many as its shaders declare; further bytes are ignored.
  virtual void push_constants(std::span<const std::byte> bytes) = 0;
  template <class T>
  void push(const T& constants) {
    push_constants(std::as_bytes(std::span(&constants, 1)));
  }

  /// offset: bytes, here and in all functions below.
  virtual void bind_vertex_stream(std::uint32_t stream, BufferHandle buffer, std::uint64_t offset) = 0;
  /// 32-bit indices.
  virtual void bind_indices(BufferHandle buffer, std::uint64_t offset) = 0;
  virtual void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
                    std::uint32_t first_instance) = 0;
  virtual void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                            std::int32_t vertex_offset, std::uint32_t first_instance) = 0;
  /// One non-indexed draw. The buffer holds its four 32-bit arguments: vertices, instances, first vertex, first
  /// instance.
  virtual void draw_indirect(BufferHandle buffer, std::uint64_t offset) = 0;
  /// Several draws. The buffer holds five 32-bit arguments per draw, tightly packed: indices, instances, first index,
  /// vertex offset, first instance.
  virtual void draw_indexed_indirect(BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) = 0;
  /// x, y, z: numbers of workgroups.
  virtual void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) = 0;
  /// The buffer holds the three 32-bit numbers of workgroups.
  virtual void dispatch_indirect(BufferHandle buffer, std::uint64_t offset) = 0;

  /// For gpu::native_commands (engine/gpu/vulkan_interop.h), which states the rules: the caller records into the
  /// command buffer of the graphics API until end_native. Returns the command buffer; null if the device has none.
  virtual void* begin_native(std::optional<std::uint64_t> revision) = 0;
  virtual void end_native() = 0;
};

}  // namespace gloam::gpu
