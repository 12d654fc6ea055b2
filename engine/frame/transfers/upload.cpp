// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/transfers/upload.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/assert.h"
#include "engine/gpu/image_size.h"

namespace gloam {

namespace {

constexpr std::uint64_t kAlignment = 256;
/// Staging bytes of one submission of the Uploader; more if a single job is larger. Two staging buffers alternate: one
/// is filled while the GPU copies from the other.
constexpr std::uint64_t kStagingBytes = std::uint64_t{12} << 20;

constexpr std::uint64_t align_up(std::uint64_t bytes, std::uint64_t alignment) {
  return (bytes + alignment - 1) / alignment * alignment;
}

Uploader::Fill copy_of(std::vector<std::byte> bytes) {
  return [bytes = std::move(bytes)](std::span<std::byte> staging) { std::ranges::copy(bytes, staging.begin()); };
}

/// Buffers that are destroyed however the upload ends.
struct StagingBuffers {
  explicit StagingBuffers(gpu::Device& owner) : device(owner) {}
  ~StagingBuffers() {
    for (const gpu::BufferHandle buffer : buffers) device.destroy(buffer);
  }
  StagingBuffers(const StagingBuffers&) = delete;
  StagingBuffers& operator=(const StagingBuffers&) = delete;

  gpu::Device& device;
  std::vector<gpu::BufferHandle> buffers;
};

}  // namespace

UploadRing::UploadRing(gpu::Device& device, std::string module, gpu::BufferUsage usage, std::uint64_t first_bytes)
    : device_(device),
      module_(std::move(module)),
      usage_(usage),
      first_bytes_(align_up(std::max<std::uint64_t>(first_bytes, 1), kAlignment)),
      slots_(gpu::Device::kFramesInFlight) {}

UploadRing::~UploadRing() {
  for (const Slot& slot : slots_) {
    for (gpu::BufferHandle block : slot.blocks) device_.destroy(block);
  }
}

void UploadRing::begin_frame() {
  Slot& slot = slots_[device_.frame_number() % slots_.size()];
  slot.block = 0;
  slot.used = 0;
  if (slot.blocks.size() < 2) return;
  // The last frame of this slot needed several blocks. Replace them by one block of the same total size.
  std::uint64_t total = 0;
  for (std::uint64_t size : slot.sizes) total += size;
  Result<gpu::BufferHandle> merged = device_.create_buffer(
      {.name = "upload ring", .module = module_, .size = total, .usage = usage_, .memory = gpu::MemoryKind::upload});
  if (!merged.ok()) return;  // keep using the blocks
  for (gpu::BufferHandle block : slot.blocks) device_.destroy(block);
  slot.blocks.assign(1, *merged);
  slot.sizes.assign(1, total);
}

Result<UploadSlice> UploadRing::allocate(std::uint64_t bytes) {
  GLOAM_ASSERT(bytes > 0, "an upload has at least one byte");
  Slot& slot = slots_[device_.frame_number() % slots_.size()];
  while (slot.block < slot.blocks.size() && slot.used + bytes > slot.sizes[slot.block]) {
    ++slot.block;
    slot.used = 0;
  }
  if (slot.block == slot.blocks.size()) {
    const std::uint64_t grown = slot.sizes.empty() ? first_bytes_ : 2 * slot.sizes.back();
    const std::uint64_t size = std::max(grown, align_up(bytes, kAlignment));
    Result<gpu::BufferHandle> block = device_.create_buffer(
        {.name = "upload ring", .module = module_, .size = size, .usage = usage_, .memory = gpu::MemoryKind::upload});
    if (!block.ok()) return block.error();
    slot.blocks.push_back(*block);
    slot.sizes.push_back(size);
  }
  const gpu::BufferHandle buffer = slot.blocks[slot.block];
  const UploadSlice slice{
      .buffer = buffer, .offset = slot.used, .bytes = device_.mapped(buffer).subspan(slot.used, bytes)};
  slot.used = align_up(slot.used + bytes, kAlignment);
  return slice;
}

Result<gpu::Binding::BufferRange> UploadRing::write(std::span<const std::byte> data) {
  Result<UploadSlice> slice = allocate(data.size());
  if (!slice.ok()) return slice.error();
  std::ranges::copy(data, slice->bytes.begin());
  return gpu::Binding::BufferRange{.buffer = slice->buffer, .offset = slice->offset, .size = data.size()};
}

void Uploader::buffer(gpu::BufferHandle target, std::vector<std::byte> bytes, gpu::Access after,
                      gpu::AccessMask also_after) {
  GLOAM_ASSERT(!bytes.empty() && bytes.size() <= device_.desc(target).size,
               "an upload fits its buffer '" + device_.desc(target).name + "' and has at least one byte");
  const std::uint64_t size = bytes.size();
  jobs_.push_back({target, {}, copy_of(std::move(bytes)), size, after, also_after});
}

void Uploader::image(gpu::ImageHandle target, std::vector<std::byte> texels, gpu::Access after) {
  const std::uint64_t size = texels.size();
  add_image(target, size, copy_of(std::move(texels)), after);
}

void Uploader::image(gpu::ImageHandle target, Fill fill, gpu::Access after) {
  add_image(target, gpu::image_bytes(device_.desc(target)), std::move(fill), after);
}

void Uploader::add_image(gpu::ImageHandle target, std::uint64_t size, Fill fill, gpu::Access after) {
  const gpu::ImageDesc& desc = device_.desc(target);
  GLOAM_ASSERT(size == gpu::image_bytes(desc),
               "an upload gives all mips of all layers of its image '" + desc.name + "'");
  jobs_.push_back({{}, target, std::move(fill), size, after});
}

Status Uploader::flush() { return flush(*make_serial_executor()); }

Status Uploader::flush(JobExecutor& executor) {
  const std::vector<Job> jobs = std::exchange(jobs_, {});
  const std::vector<Batch> batches = batches_of(jobs);
  std::array<std::uint64_t, gpu::Device::kFramesInFlight> sizes{};  // of the alternating staging buffers, in bytes
  for (std::size_t i = 0; i < batches.size(); ++i) {
    std::uint64_t& size = sizes[i % sizes.size()];
    size = std::max(size, batches[i].bytes);
  }
  StagingBuffers staging(device_);
  for (const std::uint64_t size : sizes) {
    if (size == 0) continue;
    Result<gpu::BufferHandle> buffer = device_.create_buffer({.name = "upload staging",
                                                              .module = "engine",
                                                              .size = size,
                                                              .usage = gpu::BufferUsage::transfer_source,
                                                              .memory = gpu::MemoryKind::upload});
    if (!buffer.ok()) return buffer.error();
    staging.buffers.push_back(*buffer);
  }
  return submit(batches, staging.buffers, executor);
}

std::vector<Uploader::Batch> Uploader::batches_of(std::span<const Job> jobs) {
  std::vector<Batch> batches;
  for (std::size_t first = 0; first < jobs.size();) {
    std::uint64_t bytes = align_up(jobs[first].size, kAlignment);
    std::size_t end = first + 1;
    while (end < jobs.size() && bytes + align_up(jobs[end].size, kAlignment) <= kStagingBytes)
      bytes += align_up(jobs[end++].size, kAlignment);
    batches.push_back({jobs.subspan(first, end - first), bytes});
    first = end;
  }
  return batches;
}

Status Uploader::submit(std::span<const Batch> batches, std::span<const gpu::BufferHandle> staging,
                        JobExecutor& executor) {
  if (batches.empty()) return {};
  for (std::size_t i = 0; i < batches.size(); ++i) {
    // Waits for the frame that last used this staging buffer: there are as many buffers as frames in flight.
    Result<gpu::CommandList*> commands = device_.begin_side_frame();
    if (!commands.ok()) return commands.error();
    const gpu::BufferHandle buffer = staging[i % staging.size()];
    const std::span<std::byte> mapped = device_.mapped(buffer);
    const std::span<const Job> jobs = batches[i].jobs;
    std::vector<std::function<void()>> fills;
    std::uint64_t offset = 0;
    for (const Job& job : jobs) {
      fills.emplace_back([&job, memory = mapped.subspan(offset, job.size)] { job.fill(memory); });
      offset += align_up(job.size, kAlignment);
    }
    try {
      executor.run(fills);
    } catch (...) {
      static_cast<void>(device_.abandon_frame());
      throw;
    }
    record(**commands, jobs, buffer);
    GLOAM_TRY(device_.submit_frame());
  }
  return device_.wait_idle();
}

void Uploader::record(gpu::CommandList& commands, std::span<const Job> jobs, gpu::BufferHandle staging) {
  std::vector<gpu::BufferBarrier> buffers;
  std::vector<gpu::ImageBarrier> images;
  const auto barriers = [&](bool before_copies) {
    buffers.clear();
    images.clear();
    for (const Job& job : jobs) {
      const gpu::Access before = before_copies ? gpu::Access::none : gpu::Access::transfer_write;
      const gpu::Access after = before_copies ? gpu::Access::transfer_write : job.after;
      const gpu::AccessMask also_after = before_copies ? 0 : job.also_after;
      if (job.buffer)
        buffers.push_back({.buffer = job.buffer, .before = before, .after = after, .also_after = also_after});
      if (job.image) images.push_back({.image = job.image, .before = before, .after = after});
    }
    commands.barrier(buffers, images);
  };
  barriers(true);
  std::uint64_t job_offset = 0;
  for (const Job& job : jobs) {
    if (job.buffer) {
      commands.copy_buffer(staging, job_offset, job.buffer, 0, job.size);
    } else {
      const gpu::ImageDesc& desc = device_.desc(job.image);
      std::uint64_t offset = job_offset;
      for (std::uint32_t layer = 0; layer < desc.layers; ++layer) {
        for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
          commands.copy_buffer_to_image(staging, offset, job.image, mip, layer, 1);
          offset += gpu::mip_bytes(desc, mip);
        }
      }
    }
    job_offset += align_up(job.size, kAlignment);
  }
  barriers(false);
}

}  // namespace gloam
