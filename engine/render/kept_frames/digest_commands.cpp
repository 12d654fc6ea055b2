// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/kept_frames/digest_commands.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <variant>

#include "engine/gpu/image_size.h"

namespace gloam {

enum class DigestCommands::Command : std::uint8_t {
  copy_buffer,
  copy_to_image,
  copy_rows,
  copy_from_image,
  fill,
  clear,
  blit,
  rendering,
  viewport,
  scissor,
  depth_bias,
  pipeline,
  bind,
  set,
  constants,
  stream,
  indices,
  draw,
  draw_indexed,
  draw_indirect,
  draw_indexed_indirect,
  dispatch,
  dispatch_indirect,
  native,
};

template <class... Numbers>
void DigestCommands::add(Command command, Numbers... numbers) {
  value(command);
  (value(numbers), ...);
}

template <class Number>
void DigestCommands::value(Number number) {
  inputs_.value(number);
  whole_.value(number);
}

void DigestCommands::bytes(std::span<const std::byte> data) { value(hash_bytes(data)); }

void DigestCommands::add_float(float number) { value(std::bit_cast<std::uint32_t>(number)); }

void DigestCommands::add_image(gpu::ImageHandle image) {
  unknown_ = unknown_ || (image && device_.is_foreign(image));
  whole_.value(image.index).value(image.generation);
  if (!outlives_(image, {})) inputs_.value(image.index).value(image.generation);
}

void DigestCommands::add_view(const gpu::ImageView& view) {
  add_image(view.image);
  for (const std::uint32_t number : {view.first_mip, view.mip_count, view.first_layer, view.layer_count}) value(number);
}

void DigestCommands::add_range(gpu::BufferHandle buffer, std::uint64_t offset, std::uint64_t size) {
  value(size);
  unknown_ = unknown_ || device_.is_foreign(buffer);
  switch (device_.desc(buffer).memory) {
    case gpu::MemoryKind::upload: {
      const std::span<const std::byte> data = device_.mapped(buffer).subspan(offset);
      bytes(size == 0 ? data : data.first(size));
      return;
    }
    case gpu::MemoryKind::readback:
      return;
    case gpu::MemoryKind::device:
      value(offset);
      whole_.value(buffer.index).value(buffer.generation);
      if (!outlives_({}, buffer)) inputs_.value(buffer.index).value(buffer.generation);
  }
}

void DigestCommands::add_binding(const gpu::Binding& binding) {
  value(binding.binding);
  value(binding.resource.index());
  if (const auto* range = std::get_if<gpu::Binding::BufferRange>(&binding.resource)) {
    add_range(range->buffer, range->offset, range->size);
  } else if (const auto* sampled = std::get_if<gpu::Binding::Sampled>(&binding.resource)) {
    add_view(sampled->view);
    value(sampled->sampler.index);
    value(sampled->sampler.generation);
  } else {
    add_view(std::get<gpu::Binding::Storage>(binding.resource).view);
  }
}

void DigestCommands::copy_buffer(gpu::BufferHandle source, std::uint64_t source_offset, gpu::BufferHandle target,
                                 std::uint64_t target_offset, std::uint64_t size) {
  add(Command::copy_buffer);
  add_range(source, source_offset, size);
  add_range(target, target_offset, size);
  ForwardingCommands::copy_buffer(source, source_offset, target, target_offset, size);
}

void DigestCommands::copy_buffer_to_image(gpu::BufferHandle source, std::uint64_t source_offset,
                                          gpu::ImageHandle target, std::uint32_t mip, std::uint32_t first_layer,
                                          std::uint32_t layer_count) {
  add(Command::copy_to_image, mip, first_layer, layer_count);
  add_range(source, source_offset, gpu::mip_bytes(device_.desc(target), mip) * layer_count);
  add_image(target);
  ForwardingCommands::copy_buffer_to_image(source, source_offset, target, mip, first_layer, layer_count);
}

void DigestCommands::copy_rows_to_image(gpu::BufferHandle source, std::uint64_t source_offset, gpu::ImageHandle target,
                                        std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) {
  const gpu::ImageDesc& desc = device_.desc(target);
  const std::uint64_t rows = std::max(desc.height >> mip, 1u);
  add(Command::copy_rows, mip, first_row, row_count);
  add_range(source, source_offset, gpu::mip_bytes(desc, mip) / rows * row_count);
  add_image(target);
  ForwardingCommands::copy_rows_to_image(source, source_offset, target, mip, first_row, row_count);
}

void DigestCommands::copy_image_to_buffer(gpu::ImageHandle source, std::uint32_t mip, std::uint32_t layer,
                                          gpu::BufferHandle target, std::uint64_t target_offset) {
  add(Command::copy_from_image, mip, layer);
  add_image(source);
  add_range(target, target_offset, gpu::mip_bytes(device_.desc(source), mip));
  ForwardingCommands::copy_image_to_buffer(source, mip, layer, target, target_offset);
}

void DigestCommands::fill_buffer(gpu::BufferHandle buffer, std::uint64_t offset, std::uint64_t size,
                                 std::uint32_t word) {
  add(Command::fill, word);
  add_range(buffer, offset, size);
  ForwardingCommands::fill_buffer(buffer, offset, size, word);
}

void DigestCommands::clear_color_image(gpu::ImageHandle image, std::array<std::uint32_t, 4> bits,
                                       gpu::ImageRange range) {
  add(Command::clear, bits[0], bits[1], bits[2], bits[3], range.first_mip, range.mip_count, range.first_layer,
      range.layer_count);
  add_image(image);
  ForwardingCommands::clear_color_image(image, bits, range);
}

void DigestCommands::blit(gpu::ImageHandle source, gpu::ImageHandle target, gpu::ImagePart from, gpu::ImagePart to) {
  add(Command::blit, from.mip, from.layer, to.mip, to.layer);
  add_image(source);
  add_image(target);
  ForwardingCommands::blit(source, target, from, to);
}

void DigestCommands::begin_rendering(const gpu::RenderingDesc& desc) {
  add(Command::rendering, desc.colors.size(), desc.width, desc.height, desc.x, desc.y);
  for (const gpu::ColorTarget& color : desc.colors) {
    add_view(color.view);
    value(color.load);
    for (const float channel : color.clear) add_float(channel);
  }
  add_view(desc.depth.view);
  value(desc.depth.load);
  value(desc.depth.read_only);
  add_float(desc.depth.clear);
  ForwardingCommands::begin_rendering(desc);
}

void DigestCommands::set_viewport(float x, float y, float width, float height) {
  add(Command::viewport);
  for (const float number : {x, y, width, height}) add_float(number);
  ForwardingCommands::set_viewport(x, y, width, height);
}

void DigestCommands::set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
  add(Command::scissor, x, y, width, height);
  ForwardingCommands::set_scissor(x, y, width, height);
}

void DigestCommands::set_depth_bias(float constant, float slope) {
  add(Command::depth_bias);
  add_float(constant);
  add_float(slope);
  ForwardingCommands::set_depth_bias(constant, slope);
}

void DigestCommands::bind_pipeline(gpu::PipelineHandle pipeline) {
  add(Command::pipeline, pipeline.index, pipeline.generation);
  ForwardingCommands::bind_pipeline(pipeline);
}

void DigestCommands::bind(std::span<const gpu::Binding> bindings) {
  add(Command::bind, bindings.size());
  for (const gpu::Binding& binding : bindings) add_binding(binding);
  ForwardingCommands::bind(bindings);
}

void DigestCommands::bind_set(std::uint32_t set, gpu::ResourceSetHandle resources) {
  add(Command::set, set, resources.index, resources.generation);
  ForwardingCommands::bind_set(set, resources);
}

void DigestCommands::push_constants(std::span<const std::byte> bytes) {
  add(Command::constants, bytes.size());
  this->bytes(bytes);
  ForwardingCommands::push_constants(bytes);
}

void DigestCommands::bind_vertex_stream(std::uint32_t stream, gpu::BufferHandle buffer, std::uint64_t offset) {
  add(Command::stream, stream);
  add_range(buffer, offset, 0);
  ForwardingCommands::bind_vertex_stream(stream, buffer, offset);
}

void DigestCommands::bind_indices(gpu::BufferHandle buffer, std::uint64_t offset) {
  add(Command::indices);
  add_range(buffer, offset, 0);
  ForwardingCommands::bind_indices(buffer, offset);
}

void DigestCommands::draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
                          std::uint32_t first_instance) {
  add(Command::draw, vertices, instances, first_vertex, first_instance);
  ForwardingCommands::draw(vertices, instances, first_vertex, first_instance);
}

void DigestCommands::draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                                  std::int32_t vertex_offset, std::uint32_t first_instance) {
  add(Command::draw_indexed, indices, instances, first_index, vertex_offset, first_instance);
  ForwardingCommands::draw_indexed(indices, instances, first_index, vertex_offset, first_instance);
}

void DigestCommands::draw_indirect(gpu::BufferHandle buffer, std::uint64_t offset) {
  add(Command::draw_indirect);
  add_range(buffer, offset, 4 * sizeof(std::uint32_t));
  ForwardingCommands::draw_indirect(buffer, offset);
}

void DigestCommands::draw_indexed_indirect(gpu::BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) {
  add(Command::draw_indexed_indirect, draw_count);
  if (draw_count > 0) add_range(buffer, offset, 5 * sizeof(std::uint32_t) * draw_count);
  ForwardingCommands::draw_indexed_indirect(buffer, offset, draw_count);
}

void DigestCommands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  add(Command::dispatch, x, y, z);
  ForwardingCommands::dispatch(x, y, z);
}

void DigestCommands::dispatch_indirect(gpu::BufferHandle buffer, std::uint64_t offset) {
  add(Command::dispatch_indirect);
  add_range(buffer, offset, 3 * sizeof(std::uint32_t));
  ForwardingCommands::dispatch_indirect(buffer, offset);
}

void* DigestCommands::begin_native(std::optional<std::uint64_t> revision) {
  unknown_ = unknown_ || !revision;
  add(Command::native, revision.value_or(0));
  return ForwardingCommands::begin_native(revision);
}

}  // namespace gloam
