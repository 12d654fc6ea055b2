// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/readback/capture.h"

#include <cstring>

namespace gloam {
namespace {

[[nodiscard]] Result<gpu::BufferHandle> make_target(gpu::Device& device, const std::string& name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = "capture." + name;
  desc.module = "engine";
  desc.size = bytes;
  desc.usage = gpu::BufferUsage::transfer_target;
  desc.memory = gpu::MemoryKind::readback;
  return device.create_buffer(desc);
}

[[nodiscard]] Result<Capture> make_capture(gpu::Device& device, const gpu::ImageDesc& image) {
  Capture capture;
  capture.width = image.width;
  capture.height = image.height;
  capture.texel_bytes = gpu::bytes_per_texel(image.format);
  auto buffer = make_target(device, image.name, std::uint64_t{image.width} * image.height * capture.texel_bytes);
  if (!buffer.ok()) return buffer.error();
  capture.buffer = *buffer;
  return capture;
}

}  // namespace

Result<Capture> capture_image(FrameGraph& graph, gpu::Device& device, ImageRef image) {
  auto capture = make_capture(device, graph.desc(image));
  if (!capture.ok()) return capture;
  BufferRef target = graph.import_buffer("capture", capture->buffer, gpu::Access::none, gpu::Access::host_read);
  PassBuilder pass = graph.add_pass("capture", "engine");
  pass.read(image, gpu::Access::transfer_read);
  target = pass.write(target, gpu::Access::transfer_write);
  pass.execute([image, target](PassContext& context) {
    context.commands().copy_image_to_buffer(context.image(image), 0, 0, context.buffer(target), 0);
  });
  return capture;
}

Result<Capture> capture_buffer(FrameGraph& graph, gpu::Device& device, BufferRef buffer) {
  const std::uint64_t size = graph.desc(buffer).size;
  auto made = make_target(device, graph.desc(buffer).name, size);
  if (!made.ok()) return made.error();
  BufferRef target = graph.import_buffer("capture", *made, gpu::Access::none, gpu::Access::host_read);
  PassBuilder pass = graph.add_pass("capture", "engine");
  pass.read(buffer, gpu::Access::transfer_read);
  target = pass.write(target, gpu::Access::transfer_write);
  pass.execute([buffer, target, size](PassContext& context) {
    context.commands().copy_buffer(context.buffer(buffer), 0, context.buffer(target), 0, size);
  });
  Capture capture;
  capture.buffer = *made;
  return capture;
}

std::vector<std::byte> take_capture(gpu::Device& device, const Capture& capture) {
  const std::span<const std::byte> bytes = device.mapped(capture.buffer);
  std::vector<std::byte> copy(bytes.begin(), bytes.end());
  device.destroy(capture.buffer);
  return copy;
}

Captures::~Captures() {
  for (const auto& [name, capture] : open_) device_.destroy(capture.buffer);
}

Status Captures::add(FrameGraph& graph, std::string_view name, ImageRef image) {
  GLOAM_ASSERT(!open_.contains(name), "a copy has a name of its own");
  auto capture = capture_image(graph, device_, image);
  if (!capture.ok()) return capture.error();
  open_.emplace(name, *capture);
  return {};
}

Status Captures::add(FrameGraph& graph, std::string_view name, BufferRef buffer) {
  GLOAM_ASSERT(!open_.contains(name), "a copy has a name of its own");
  auto capture = capture_buffer(graph, device_, buffer);
  if (!capture.ok()) return capture.error();
  open_.emplace(name, *capture);
  return {};
}

void Captures::finish() {
  for (const auto& [name, capture] : open_) done_[name] = take_capture(device_, capture);
  open_.clear();
}

std::span<const std::byte> Captures::bytes(std::string_view name) const {
  const auto found = done_.find(name);
  return found == done_.end() ? std::span<const std::byte>() : found->second;
}

void Captures::copy_item(std::string_view name, std::size_t offset, std::span<std::byte> target) const {
  const std::span<const std::byte> source = bytes(name);
  GLOAM_ASSERT(offset + target.size() <= source.size(), "an item lies in a finished copy");
  std::memcpy(target.data(), source.data() + offset, target.size());
}

Result<std::vector<std::byte>> read_image_now(gpu::Device& device, gpu::ImageHandle image) {
  auto capture = make_capture(device, device.desc(image));
  if (!capture.ok()) return capture.error();
  const auto copy = [&]() -> Status {
    auto commands = device.begin_side_frame();
    if (!commands.ok()) return commands.error();
    (*commands)->copy_image_to_buffer(image, 0, 0, capture->buffer, 0);
    const gpu::BufferBarrier ready{capture->buffer, gpu::Access::transfer_write, gpu::Access::host_read};
    (*commands)->barrier(std::span(&ready, 1), {});
    GLOAM_TRY(device.submit_frame());
    return device.wait_idle();
  };
  const Status copied = copy();
  std::vector<std::byte> bytes = take_capture(device, *capture);
  if (!copied.ok()) return copied.error();
  return bytes;
}

}  // namespace gloam
