// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/gpu/types.h"

namespace gloam::gpu {

/// Records GPU work of one frame, in order. Valid between Device::begin_frame and Device::submit_frame, on one thread.
class CommandList {
 public:
  virtual ~CommandList() = default;

  virtual void begin_label(std::string_view name) = 0;
  virtual void end_label() = 0;
  /// Nanoseconds on the device clock when all earlier work has ended; index < Device::kTimestampsPerFrame, each once a
  /// frame.
  virtual void write_timestamp(std::uint32_t index) = 0;

  virtual void barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) = 0;

  virtual void copy_buffer(BufferHandle source, std::uint64_t source_offset, BufferHandle target,
                           std::uint64_t target_offset, std::uint64_t size) = 0;
  /// Tightly packed texels of one mip, layers `first_layer` … + `layer_count`.
  virtual void copy_buffer_to_image(BufferHandle source, std::uint64_t source_offset, ImageHandle target,
                                    std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) = 0;
  virtual void copy_image_to_buffer(ImageHandle source, std::uint32_t mip, std::uint32_t layer, BufferHandle target,
                                    std::uint64_t target_offset) = 0;
  /// size is a multiple of 4.
  virtual void fill_buffer(BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) = 0;
  virtual void clear_color_image(ImageHandle image, std::array<std::uint32_t, 4> bits) = 0;
  /// Scales colour images with a linear filter; both images must be in transfer layouts.
  virtual void blit(ImageHandle source, ImageHandle target) = 0;

  virtual void begin_rendering(const RenderingDesc& desc) = 0;
  virtual void end_rendering() = 0;
  /// Pixels from the top left. The viewport is flipped so that clip space has Y up.
  virtual void set_viewport(float x, float y, float width, float height) = 0;
  virtual void set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) = 0;
  virtual void set_depth_bias(float constant, float slope) = 0;

  virtual void bind_pipeline(PipelineHandle pipeline) = 0;
  /// Binds all resources of set 0 of the bound pipeline; every binding of the shader must be given.
  virtual void bind(std::span<const Binding> bindings) = 0;
  /// Binds a prepared set with a number ≥ 1.
  virtual void bind_set(std::uint32_t set, ResourceSetHandle resources) = 0;
  virtual void push_constants(std::span<const std::byte> bytes) = 0;
  template <class T>
  void push(const T& constants) {
    push_constants(std::as_bytes(std::span(&constants, 1)));
  }

  virtual void bind_vertex_stream(std::uint32_t stream, BufferHandle buffer, std::uint64_t offset) = 0;
  /// 32-bit indices.
  virtual void bind_indices(BufferHandle buffer, std::uint64_t offset) = 0;
  virtual void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
                    std::uint32_t first_instance) = 0;
  virtual void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                            std::int32_t vertex_offset, std::uint32_t first_instance) = 0;
  /// One draw without indices, its four words (vertices, instances, first vertex, first instance) from a buffer.
  virtual void draw_indirect(BufferHandle buffer, std::uint64_t offset) = 0;
  virtual void draw_indexed_indirect(BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) = 0;
  virtual void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) = 0;
  virtual void dispatch_indirect(BufferHandle buffer, std::uint64_t offset) = 0;
};

}  // namespace gloam::gpu
