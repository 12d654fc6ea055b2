// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "engine/core/hash.h"
#include "engine/frame/forwarding_commands.h"
#include "engine/gpu/device.h"

namespace gloam {

/// What a frame does: its commands, and the data that the CPU has written for it.
struct FrameDigest {
  std::uint64_t inputs = 0;  ///< without the places of resources whose roles swap from frame to frame
  std::uint64_t whole = 0;   ///< with them
  bool operator==(const FrameDigest&) const = default;
};

/// Forwards the commands of a frame to another CommandList and hashes what decides their results. What the CPU has
/// written for the frame (MemoryKind::upload) counts by its bytes, because each frame has another place for it; all
/// other objects count by their handles. Where results are copied to for the CPU does not count, nor do labels,
/// timestamps and barriers.
class DigestCommands final : public frame::ForwardingCommands {
 public:
  /// outlives: whether an object's contents are left by one frame for the next (History::owns). Such objects may swap
  /// their roles, and do not count in FrameDigest::inputs.
  using Outlives = std::function<bool(gpu::ImageHandle, gpu::BufferHandle)>;
  DigestCommands(gpu::CommandList& next, gpu::Device& device, Outlives outlives)
      : ForwardingCommands(next), device_(device), outlives_(std::move(outlives)) {}

  /// None if the frame uses an image of a window, an image or a buffer of a host, whose contents are not known, or
  /// native commands without a revision.
  [[nodiscard]] std::optional<FrameDigest> digest() const {
    return unknown_ ? std::nullopt : std::optional(FrameDigest{inputs_.digest(), whole_.digest()});
  }

  void copy_buffer(gpu::BufferHandle source, std::uint64_t source_offset, gpu::BufferHandle target,
                   std::uint64_t target_offset, std::uint64_t size) override;
  void copy_buffer_to_image(gpu::BufferHandle source, std::uint64_t source_offset, gpu::ImageHandle target,
                            std::uint32_t mip, std::uint32_t first_layer, std::uint32_t layer_count) override;
  void copy_rows_to_image(gpu::BufferHandle source, std::uint64_t source_offset, gpu::ImageHandle target,
                          std::uint32_t mip, std::uint32_t first_row, std::uint32_t row_count) override;
  void copy_image_to_buffer(gpu::ImageHandle source, std::uint32_t mip, std::uint32_t layer, gpu::BufferHandle target,
                            std::uint64_t target_offset) override;
  void fill_buffer(gpu::BufferHandle buffer, std::uint64_t offset, std::uint64_t size, std::uint32_t word) override;
  void clear_color_image(gpu::ImageHandle image, std::array<std::uint32_t, 4> bits, gpu::ImageRange range) override;
  void blit(gpu::ImageHandle source, gpu::ImageHandle target, gpu::ImagePart from, gpu::ImagePart to) override;
  void begin_rendering(const gpu::RenderingDesc& desc) override;
  void set_viewport(float x, float y, float width, float height) override;
  void set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) override;
  void set_depth_bias(float constant, float slope) override;
  void bind_pipeline(gpu::PipelineHandle pipeline) override;
  void bind(std::span<const gpu::Binding> bindings) override;
  void bind_set(std::uint32_t set, gpu::ResourceSetHandle resources) override;
  void push_constants(std::span<const std::byte> bytes) override;
  void bind_vertex_stream(std::uint32_t stream, gpu::BufferHandle buffer, std::uint64_t offset) override;
  void bind_indices(gpu::BufferHandle buffer, std::uint64_t offset) override;
  void draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
            std::uint32_t first_instance) override;
  void draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                    std::int32_t vertex_offset, std::uint32_t first_instance) override;
  void draw_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override;
  void draw_indexed_indirect(gpu::BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) override;
  void dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) override;
  void dispatch_indirect(gpu::BufferHandle buffer, std::uint64_t offset) override;
  void* begin_native(std::optional<std::uint64_t> revision) override;

 private:
  enum class Command : std::uint8_t;
  template <class... Numbers>
  void add(Command command, Numbers... numbers);
  template <class Number>
  void value(Number number);
  void bytes(std::span<const std::byte> data);
  void add_float(float number);
  void add_image(gpu::ImageHandle image);
  void add_view(const gpu::ImageView& view);
  /// A range that the command reads or writes. size 0: to the end of the buffer.
  void add_range(gpu::BufferHandle buffer, std::uint64_t offset, std::uint64_t size);
  void add_binding(const gpu::Binding& binding);

  gpu::Device& device_;
  Outlives outlives_;
  Hasher inputs_, whole_;
  bool unknown_ = false;  ///< the commands read something that has no hash
};

}  // namespace gloam
