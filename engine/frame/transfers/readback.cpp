// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/readback.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/core/assert.h"
#include "engine/gpu/image_size.h"

namespace gloam {

namespace {
constexpr std::uint64_t kSmallestReadback = 256;  ///< bytes; sizes are powers of two, so that buffers can be reused
}

Readback::Readback(gpu::Device& device, std::string module) : device_(device), module_(std::move(module)) {}

Readback::~Readback() {
  for (const auto& request : requests_) device_.destroy(request->buffer);
  for (gpu::BufferHandle buffer : free_buffers_) device_.destroy(buffer);
}

Result<Readback::Request*> Readback::make_request(std::uint64_t size) {
  recycle_finished();
  const std::uint64_t capacity = std::bit_ceil(std::max(size, kSmallestReadback));
  gpu::BufferHandle buffer;
  const auto found = std::ranges::find_if(
      free_buffers_, [&](gpu::BufferHandle handle) { return device_.desc(handle).size == capacity; });
  if (found != free_buffers_.end()) {
    buffer = *found;
    free_buffers_.erase(found);
  } else {
    Result<gpu::BufferHandle> made = device_.create_buffer({.name = "readback",
                                                            .module = module_,
                                                            .size = capacity,
                                                            .usage = gpu::BufferUsage::transfer_target,
                                                            .memory = gpu::MemoryKind::readback});
    if (!made.ok()) return made.error();
    buffer = *made;
  }
  requests_.push_back(std::make_unique<Request>(
      Request{.id = ++last_id_, .buffer = buffer, .size = size, .frame = device_.frame_number()}));
  return requests_.back().get();
}

BufferRef Readback::import_target(FrameGraph& graph, const Request& request) {
  return graph.import_buffer("readback", request.buffer, gpu::Access::host_read, gpu::Access::host_read);
}

Result<ReadbackTicket> Readback::read_image(FrameGraph& graph, ImageRef image, std::uint32_t mip, std::uint32_t layer) {
  const gpu::ImageDesc& desc = graph.desc(image);
  GLOAM_ASSERT(mip < desc.mips && layer < desc.layers, "image '" + desc.name + "' has no such mip or layer");
  Result<Request*> made = make_request(gpu::mip_bytes(desc, mip));
  if (!made.ok()) return made.error();
  Request* request = *made;
  const BufferRef imported = import_target(graph, *request);
  PassBuilder pass = graph.add_pass("readback", module_);
  pass.read(image, gpu::Access::transfer_read);
  const BufferRef target = pass.write(imported, gpu::Access::transfer_write);
  pass.execute([this, request, image, target, mip, layer](PassContext& context) {
    context.commands().copy_image_to_buffer(context.image(image), mip, layer, context.buffer(target), 0);
    request->frame = device_.frame_number();
    request->recorded = true;
  });
  return ReadbackTicket{request->id};
}

Result<ReadbackTicket> Readback::read_buffer(FrameGraph& graph, BufferRef buffer, std::uint64_t offset,
                                             std::uint64_t size) {
  const gpu::BufferDesc& desc = graph.desc(buffer);
  GLOAM_ASSERT(offset < desc.size && size <= desc.size - offset, "buffer '" + desc.name + "' has no such range");
  if (size == 0) size = desc.size - offset;
  Result<Request*> made = make_request(size);
  if (!made.ok()) return made.error();
  Request* request = *made;
  const BufferRef imported = import_target(graph, *request);
  PassBuilder pass = graph.add_pass("readback", module_);
  pass.read(buffer, gpu::Access::transfer_read);
  const BufferRef target = pass.write(imported, gpu::Access::transfer_write);
  pass.execute([this, request, buffer, target, offset](PassContext& context) {
    context.commands().copy_buffer(context.buffer(buffer), offset, context.buffer(target), 0, request->size);
    request->frame = device_.frame_number();
    request->recorded = true;
  });
  return ReadbackTicket{request->id};
}

std::optional<std::vector<std::byte>> Readback::take(ReadbackTicket ticket) {
  const auto found = std::ranges::find_if(
      requests_, [&](const auto& request) { return request->id == ticket.id && !request->dropped; });
  if (found == requests_.end()) return std::nullopt;
  const Request& request = **found;
  if (!request.recorded || device_.completed_frames() <= request.frame) return std::nullopt;
  const auto bytes = device_.mapped(request.buffer).first(request.size);
  std::vector<std::byte> result(bytes.begin(), bytes.end());
  free_buffers_.push_back(request.buffer);
  requests_.erase(found);
  return result;
}

void Readback::drop(ReadbackTicket ticket) {
  for (const auto& request : requests_) {
    if (request->id == ticket.id) request->dropped = true;
  }
}

std::size_t Readback::open_requests() const {
  return static_cast<std::size_t>(std::ranges::count_if(requests_, [](const auto& r) { return !r->dropped; }));
}

void Readback::recycle_finished() {
  std::erase_if(requests_, [&](const auto& request) {
    const bool finished = request->dropped && device_.completed_frames() > request->frame;
    if (finished) free_buffers_.push_back(request->buffer);
    return finished;
  });
}

}  // namespace gloam
