// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/capture.h"

namespace gloam {
namespace {

[[nodiscard]] Result<Capture> make_capture(gpu::Device& device, const gpu::ImageDesc& image) {
  Capture capture;
  capture.width = image.width;
  capture.height = image.height;
  capture.texel_bytes = gpu::bytes_per_texel(image.format);
  gpu::BufferDesc desc;
  desc.name = "capture." + image.name;
  desc.module = "engine";
  desc.size = std::uint64_t{image.width} * image.height * capture.texel_bytes;
  desc.usage = gpu::BufferUsage::transfer_target;
  desc.memory = gpu::MemoryKind::readback;
  auto buffer = device.create_buffer(desc);
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

std::vector<std::byte> take_capture(gpu::Device& device, const Capture& capture) {
  const std::span<const std::byte> bytes = device.mapped(capture.buffer);
  std::vector<std::byte> copy(bytes.begin(), bytes.end());
  device.destroy(capture.buffer);
  return copy;
}

Result<std::vector<std::byte>> read_image_now(gpu::Device& device, gpu::ImageHandle image) {
  auto capture = make_capture(device, device.desc(image));
  if (!capture.ok()) return capture.error();
  auto commands = device.begin_frame();
  if (!commands.ok()) return commands.error();
  (*commands)->copy_image_to_buffer(image, 0, 0, capture->buffer, 0);
  const gpu::BufferBarrier ready{capture->buffer, gpu::Access::transfer_write, gpu::Access::host_read};
  (*commands)->barrier(std::span(&ready, 1), {});
  GLOAM_TRY(device.submit_frame());
  GLOAM_TRY(device.wait_idle());
  return take_capture(device, *capture);
}

}  // namespace gloam
