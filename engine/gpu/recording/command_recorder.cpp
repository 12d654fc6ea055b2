// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/recording/command_recorder.h"

#include <algorithm>

#include "engine/gpu/device.h"

namespace gloam::gpu::recording {

namespace {

std::string numbers(std::initializer_list<std::int64_t> values) {
  std::string text;
  for (std::int64_t value : values) text += (text.empty() ? "" : " ") + std::to_string(value);
  return text;
}

template <class Barrier>
std::string text_of_barrier(const Barrier& barrier, const std::string& object) {
  std::string text = object + " " + std::string(name_of(barrier.before));
  if (barrier.also_before != 0) text += "|" + text_of(barrier.also_before);
  text += ">" + std::string(name_of(barrier.after));
  if (barrier.also_after != 0) text += "|" + text_of(barrier.also_after);
  return text;
}

constexpr std::uint64_t kNanosecondsPerTimestamp = 1000;
constexpr std::uint64_t kDispatchCommandBytes = 12;
constexpr std::uint64_t kDrawCommandBytes = 20;  // of an indexed draw
constexpr std::uint64_t kPlainDrawCommandBytes = 16;

}  // namespace

void CommandRecorder::begin_frame(std::uint64_t frame) {
  recording_ = true;
  timestamps_.assign(Device::kTimestampsPerFrame, 0);
  tracker_.begin_frame(frame);
  pipeline_ = {};
  bindings_.clear();
  sets_.clear();
  vertex_streams_.clear();
  indices_ = {};
}

std::vector<std::uint64_t> CommandRecorder::end_frame() {
  if (rendering_) fault("submit_frame", "begin_rendering has no end_rendering");
  if (native_) fault("submit_frame", "native commands have not ended");
  native_ = false;
  if (tracker_.label_open()) fault("submit_frame", "a label is still open");
  while (tracker_.end_label()) {
  }
  rendering_ = false;
  recording_ = false;
  return std::move(timestamps_);
}

void CommandRecorder::abandon_frame() {
  tracker_.abandon_frame();
  native_ = false;
  while (tracker_.end_label()) {
  }
  rendering_ = false;
  recording_ = false;
}

void CommandRecorder::fault(std::string_view command, const std::string& text) {
  objects_.fault(std::string(command) + ": " + text);
}

void CommandRecorder::note(std::string_view command, std::string text, Place place) {
  commands_.push_back(
      {.name = std::string(command), .text = std::string(command) + (text.empty() ? "" : " ") + std::move(text)});
  if (!recording_) fault(command, "recorded outside begin_frame and submit_frame");
  if (native_) fault(command, "recorded before the host's native commands have ended");
  if (place == Place::outside_rendering && rendering_) fault(command, "not allowed between begin and end of rendering");
  if (place == Place::inside_rendering && !rendering_)
    fault(command, "only allowed between begin and end of rendering");
}

std::string CommandRecorder::name(BufferHandle handle) const {
  const Buffer* buffer = objects_.buffers.find(handle);
  return buffer == nullptr ? "dead buffer" : "'" + buffer->desc.name + "'";
}

std::string CommandRecorder::name(ImageHandle handle) const {
  const Image* image = objects_.images.find(handle);
  return image == nullptr ? "dead image" : "'" + image->desc.name + "'";
}

void CommandRecorder::begin_label(std::string_view label) {
  note("begin_label", std::string(label), Place::anywhere);
  tracker_.begin_label();
}

void CommandRecorder::end_label() {
  note("end_label", "", Place::anywhere);
  if (!tracker_.end_label()) fault("end_label", "no label is open");
}

void CommandRecorder::write_timestamp(std::uint32_t index) {
  note("write_timestamp", std::to_string(index), Place::anywhere);
  if (index >= timestamps_.size()) return fault("write_timestamp", std::to_string(index) + " is out of range");
  if (timestamps_[index] != 0) fault("write_timestamp", std::to_string(index) + " is written twice in one frame");
  clock_ns_ += kNanosecondsPerTimestamp;
  timestamps_[index] = clock_ns_;
}

void CommandRecorder::barrier(std::span<const BufferBarrier> buffers, std::span<const ImageBarrier> images) {
  std::string text;
  for (const BufferBarrier& b : buffers) text += (text.empty() ? "" : ", ") + text_of_barrier(b, name(b.buffer));
  for (const ImageBarrier& b : images)
    text += (text.empty() ? "" : ", ") + text_of_barrier(b, name(b.image) + gpu::text_of(b.range));
  note("barrier", std::move(text), Place::outside_rendering);
  tracker_.barrier(buffers, images);
}

void CommandRecorder::use_target(const ImageView& view, ImageUsage usage, Access access) {
  const std::uint32_t layer_end = view.first_layer + std::max(view.layer_count, 1u);
  if (image_for(view.image, usage, view.first_mip, layer_end, "begin_rendering") != nullptr) {
    tracker_.use(view.image, {view.first_mip, 1, view.first_layer, view.layer_count}, mask_of(access),
                 "begin_rendering");
  }
}

void CommandRecorder::begin_rendering(const RenderingDesc& desc) {
  std::string text = numbers({desc.width, desc.height});
  if (desc.x != 0 || desc.y != 0) text += " at " + numbers({desc.x, desc.y});
  for (const ColorTarget& color : desc.colors) text += " color " + name(color.view.image);
  if (desc.depth.view.image) text += " depth " + name(desc.depth.view.image);
  note("begin_rendering", std::move(text), Place::outside_rendering);
  if (desc.width == 0 || desc.height == 0) fault("begin_rendering", "the area is empty");
  for (const ColorTarget& color : desc.colors) use_target(color.view, ImageUsage::color_target, Access::color_target);
  if (desc.depth.view.image) {
    use_target(desc.depth.view, ImageUsage::depth_target,
               desc.depth.read_only ? Access::depth_test : Access::depth_target);
  }
  rendering_ = true;
}

void CommandRecorder::end_rendering() {
  note("end_rendering", "", Place::inside_rendering);
  rendering_ = false;
}

void CommandRecorder::set_viewport(float x, float y, float width, float height) {
  note("set_viewport",
       std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(width) + " " + std::to_string(height),
       Place::anywhere);
}

void CommandRecorder::set_scissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
  note("set_scissor", numbers({x, y, width, height}), Place::anywhere);
}

void CommandRecorder::set_depth_bias(float constant, float slope) {
  note("set_depth_bias", std::to_string(constant) + " " + std::to_string(slope), Place::anywhere);
}

void CommandRecorder::bind_pipeline(PipelineHandle handle) {
  const Pipeline* pipeline = objects_.pipelines.find(handle);
  note("bind_pipeline", pipeline == nullptr ? "dead pipeline" : "'" + pipeline->name + "'", Place::anywhere);
  if (pipeline == nullptr) fault("bind_pipeline", "a pipeline that is not alive");
  pipeline_ = handle;
  bindings_.clear();
  sets_.clear();
}

void* CommandRecorder::begin_native(std::optional<std::uint64_t> revision) {
  note("begin_native", revision ? std::to_string(*revision) : "", Place::anywhere);
  native_ = true;
  pipeline_ = {};
  bindings_.clear();
  sets_.clear();
  vertex_streams_.clear();
  indices_ = {};
  return nullptr;
}

void CommandRecorder::end_native() {
  native_ = false;
  note("end_native", "", Place::anywhere);
}

void CommandRecorder::push_constants(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text = std::to_string(bytes.size()) + " bytes ";
  for (std::byte b : bytes) {
    text += kDigits[static_cast<unsigned>(b) >> 4];
    text += kDigits[static_cast<unsigned>(b) & 15];
  }
  note("push_constants", std::move(text), Place::anywhere);
  if (!pipeline_) fault("push_constants", "no pipeline is bound");
}

void CommandRecorder::bind_vertex_stream(std::uint32_t stream, BufferHandle buffer, std::uint64_t offset) {
  note("bind_vertex_stream", std::to_string(stream) + " " + name(buffer) + " " + std::to_string(offset),
       Place::anywhere);
  if (buffer_for(buffer, BufferUsage::vertex, offset, 0, "bind_vertex_stream") == nullptr) return;
  if (vertex_streams_.size() <= stream) vertex_streams_.resize(stream + 1);
  vertex_streams_[stream] = buffer;
}

void CommandRecorder::bind_indices(BufferHandle buffer, std::uint64_t offset) {
  note("bind_indices", name(buffer) + " " + std::to_string(offset), Place::anywhere);
  if (buffer_for(buffer, BufferUsage::index, offset, 0, "bind_indices") != nullptr) indices_ = buffer;
}

void CommandRecorder::use_pipeline(bool compute, std::string_view command) {
  const Pipeline* pipeline = objects_.pipelines.find(pipeline_);
  if (pipeline == nullptr) {
    fault(command, "no pipeline is bound");
  } else if (pipeline->compute != compute) {
    fault(command, "pipeline '" + pipeline->name + "' is of the wrong kind");
  }
  use_bindings(compute, command);
}

void CommandRecorder::use_for_draw(bool indexed, std::string_view command) {
  use_pipeline(false, command);
  const Pipeline* pipeline = objects_.pipelines.find(pipeline_);
  const std::uint32_t streams = pipeline == nullptr ? 0 : pipeline->vertex_streams;
  for (std::uint32_t i = 0; i < streams; ++i) {
    if (i < vertex_streams_.size() && vertex_streams_[i]) {
      tracker_.use(vertex_streams_[i], mask_of(Access::vertex_input), command);
    } else {
      fault(command, "vertex stream " + std::to_string(i) + " is not bound");
    }
  }
  if (!indexed) return;
  if (indices_) {
    tracker_.use(indices_, mask_of(Access::vertex_input), command);
  } else {
    fault(command, "no indices are bound");
  }
}

void CommandRecorder::draw(std::uint32_t vertices, std::uint32_t instances, std::uint32_t first_vertex,
                           std::uint32_t first_instance) {
  note("draw", numbers({vertices, instances, first_vertex, first_instance}), Place::inside_rendering);
  use_for_draw(false, "draw");
}

void CommandRecorder::draw_indexed(std::uint32_t indices, std::uint32_t instances, std::uint32_t first_index,
                                   std::int32_t vertex_offset, std::uint32_t first_instance) {
  note("draw_indexed", numbers({indices, instances, first_index, vertex_offset, first_instance}),
       Place::inside_rendering);
  use_for_draw(true, "draw_indexed");
}

void CommandRecorder::draw_indirect(BufferHandle buffer, std::uint64_t offset) {
  note("draw_indirect", name(buffer) + " " + std::to_string(offset), Place::inside_rendering);
  use_for_draw(false, "draw_indirect");
  if (buffer_for(buffer, BufferUsage::indirect, offset, kPlainDrawCommandBytes, "draw_indirect")) {
    tracker_.use(buffer, mask_of(Access::indirect_read), "draw_indirect");
  }
}

void CommandRecorder::draw_indexed_indirect(BufferHandle buffer, std::uint64_t offset, std::uint32_t draw_count) {
  note("draw_indexed_indirect", name(buffer) + " " + std::to_string(offset) + " " + std::to_string(draw_count),
       Place::inside_rendering);
  use_for_draw(true, "draw_indexed_indirect");
  if (buffer_for(buffer, BufferUsage::indirect, offset, draw_count * kDrawCommandBytes, "draw_indexed_indirect")) {
    tracker_.use(buffer, mask_of(Access::indirect_read), "draw_indexed_indirect");
  }
}

void CommandRecorder::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  note("dispatch", numbers({x, y, z}), Place::outside_rendering);
  use_pipeline(true, "dispatch");
}

void CommandRecorder::dispatch_indirect(BufferHandle buffer, std::uint64_t offset) {
  note("dispatch_indirect", name(buffer) + " " + std::to_string(offset), Place::outside_rendering);
  use_pipeline(true, "dispatch_indirect");
  if (buffer_for(buffer, BufferUsage::indirect, offset, kDispatchCommandBytes, "dispatch_indirect")) {
    tracker_.use(buffer, mask_of(Access::indirect_read), "dispatch_indirect");
  }
}

}  // namespace gloam::gpu::recording
