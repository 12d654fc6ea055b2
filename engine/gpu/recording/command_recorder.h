// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/gpu/recording/objects.h"
#include "engine/gpu/recording/tracker.h"

namespace gloam::gpu::recording {

/// Records commands, checks them for faults, and executes copies and fills at once.
class CommandRecorder final : public CommandList {
 public:
  explicit CommandRecorder(Objects& objects) : objects_(objects), tracker_(objects) {}

  void begin_frame(std::uint64_t frame);
  /// Ends the frame and returns its timestamps in nanoseconds, by index.
  [[nodiscard]] std::vector<std::uint64_t> end_frame();
  /// Ends the frame, wherever it stands, and undoes what its commands did to the states of objects.
  void abandon_frame();
  void idle() { tracker_.idle(); }
  [[nodiscard]] bool recording() const { return recording_; }
  [[nodiscard]] const std::vector<RecordedCommand>& commands() const { return commands_; }
  void forget_commands() { commands_.clear(); }

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
  enum class Place { anywhere, outside_rendering, inside_rendering };
  /// Records the command. Reports a fault if the command is not allowed here.
  void note(std::string_view name, std::string text, Place place);
  void fault(std::string_view command, const std::string& text);
  [[nodiscard]] std::string name(BufferHandle buffer) const;
  [[nodiscard]] std::string name(ImageHandle image) const;
  [[nodiscard]] std::string text_of(const Binding& binding) const;
  /// Returns the buffer if it is alive, has the usage flag and contains [offset, offset + size); otherwise reports a
  /// fault and returns null.
  Buffer* buffer_for(BufferHandle handle, BufferUsage usage, std::uint64_t offset, std::uint64_t size,
                     std::string_view command);
  /// Returns the image if it is alive, has the usage flag, the mip and the layers; otherwise reports a fault and
  /// returns null.
  Image* image_for(ImageHandle handle, ImageUsage usage, std::uint32_t mip, std::uint32_t layer_end,
                   std::string_view command);
  void use_target(const ImageView& view, ImageUsage usage, Access access);
  void use_bindings(bool compute, std::string_view command);
  void use_binding(const Binding& binding, bool compute, std::string_view command);
  void use_pipeline(bool compute, std::string_view command);
  void use_for_draw(bool indexed, std::string_view command);

  Objects& objects_;
  Tracker tracker_;
  std::vector<RecordedCommand> commands_;
  std::vector<std::uint64_t> timestamps_;
  std::uint64_t clock_ns_ = 0;
  bool recording_ = false;
  bool rendering_ = false;
  bool native_ = false;  ///< a host is recording
  PipelineHandle pipeline_;
  std::vector<Binding> bindings_;             ///< bound to set 0
  std::vector<ResourceSetHandle> sets_;       ///< by set number; none where nothing is bound
  std::vector<BufferHandle> vertex_streams_;  ///< by stream number
  BufferHandle indices_;
};

/// The bytes of a buffer, allocated as zeros on first use.
[[nodiscard]] std::span<std::byte> bytes_of(Buffer& buffer);

/// Reports a fault for every binding that names a dead object, reaches past its end, lacks a usage flag or is given
/// twice.
void check_bindings(Objects& objects, std::span<const Binding> bindings, std::string_view command);

}  // namespace gloam::gpu::recording
