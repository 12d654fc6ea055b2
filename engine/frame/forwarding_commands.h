// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/command_list.h"

namespace gloam::frame {

/// Forwards every command to another CommandList. Derived lists override what they look at.
class ForwardingCommands : public gpu::CommandList {
 public:
  explicit ForwardingCommands(gpu::CommandList& next) : next_(next) {}

  void begin_label(std::string_view name) override { next_.begin_label(name); }
  void end_label() override { next_.end_label(); }
  void write_timestamp(std::uint32_t index) override { next_.write_timestamp(index); }
  void barrier(std::span<const gpu::BufferBarrier> buffers, std::span<const gpu::ImageBarrier> images) override {
    next_.barrier(buffers, images);
  }
  void copy_buffer(gpu::BufferHandle source, std::uint64_t source_offset, gpu::BufferHandle target,
                   std::uint64_t target_offset, std::uint64_t size) override {
    next_.copy_buffer(source, source_offset, target, target_offset, size);
  }
  void copy_buffer_to_image(gpu::BufferHandle source, std::uint64_t source_offset, gpu::ImageHandle target,
                            std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) override {
    next_.copy_buffer_to_image(source, source_offset, target, mip, first_layer, layer_count);
  }
  void copy_rows_to_image(gpu::BufferHandle source, std::uint64_t source_offset, gpu::ImageHandle target,
                          std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) override {
    next_.copy_rows_to_image(source, source_offset, target, mip, first_row, row_count);
  }
  void copy_image_to_buffer(gpu::ImageHandle source, std::uint32_t mip, std::uint32_t layer, gpu::BufferHandle target,
                            std::uint64_t target_offset) override {
    next_.copy_image_to_buffer(source, mip, layer, target, target_offset);
  }
  void fill_buffer(gpu::BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) override {
    next_.fill_buffer(buffer, offset, size, word);
  }
  void clear_color_image(gpu::ImageHandle image, std::array<std::uint32_t, 4> bits, gpu::ImageRange range) override {
    next_.clear_color_image(image, bits, range);
  }
  void blit(gpu::ImageHandle source, gpu::ImageHandle target, gpu::ImagePart from, gpu::ImagePart to) override {
    next_.blit(source, target, from, to);
  }
  void begin_rendering(const gpu::RenderingDesc& desc) override { next_.begin_rendering(desc); }
  void end_rendering() override { next_.end_rendering(); }
  void set_viewport(float x, float y, float width, float height) override { next_.set_viewport(x, y, width, height); }
  void set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) override {
    next_.set_scissor(x, y, width, height);
  }
  void set_depth_bias(float constant, float slope) override { next_.set_depth_bias(constant, slope); }
  void bind_pipeline(gpu::PipelineHandle pipeline) override { next_.bind_pipeline(pipeline); }
  void bind(std::span<const gpu::Binding> bindings) override { next_.bind(bindings); }
  void bind_set(std::uint32_t set, gpu::ResourceSetHandle resources) override { next_.bind_set(set, resources); }
  void push_constants(std::span<const std::byte> bytes) override { next_.push_constants(bytes); }
  void bind_vertex_stream(std::uint32_t stream, gpu::BufferHandle buffer, std::uint64_t offset) override {
    next_.bind_vertex_stream(stream, buffer, offset);
  }
  void bind_indices(gpu::BufferHandle buffer, std::uint64_t offset) override { next_.bind_indices(buffer, offset); }
  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
            std::uint32_t first_instance) override {
    next_.draw(vertices, instances, first_vertex, first_instance);
  }
  void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                    std::int32_t vertex_offset, std::uint32_t first_instance) override {
    next_.draw_indexed(indices, instances, first_index, vertex_offset, first_instance);
  }
  void draw_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override { next_.draw_indirect(buffer, offset); }
  void draw_indexed_indirect(gpu::BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) override {
    next_.draw_indexed_indirect(buffer, offset, draw_count);
  }
  void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) override { next_.dispatch(x, y, z); }
  void dispatch_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override {
    next_.dispatch_indirect(buffer, offset);
  }
  void* begin_native(std::optional<std::uint64_t> revision) override { return next_.begin_native(revision); }
  void end_native() override { next_.end_native(); }

 private:
  gpu::CommandList& next_;
};

}  // namespace gloam::frame
