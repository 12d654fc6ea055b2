// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/uploads/asset_uploads.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/assert.h"
#include "engine/gpu/image_size.h"

namespace gloam {

bool AssetUploads::done(const Pending& pending) {
  return pending.part == pending.job.parts.size() &&
         (!pending.job.image || pending.offset == pending.job.texels.size());
}

void AssetUploads::add(Job job) {
  std::erase_if(job.parts, [](const BufferPart& part) { return part.bytes.empty(); });
  GLOAM_ASSERT(!job.image || job.texels.size() == gpu::image_bytes(device_.desc(job.image)),
               "an upload gives all mips of its image");
  jobs_.push_back({std::move(job)});
}

void AssetUploads::cancel(std::uint64_t number) {
  std::erase_if(jobs_, [number](const Pending& pending) { return pending.job.number == number; });
}

Result<UploadSlice> AssetUploads::staged_slice(std::span<const std::byte> bytes) {
  Result<UploadSlice> slice = staging_.ring(device_).allocate(bytes.size());
  if (slice.ok()) std::ranges::copy(bytes, slice->bytes.begin());
  return slice;
}

Status AssetUploads::stage_parts(Pending& pending, std::uint64_t budget, std::uint64_t& staged) {
  while (pending.part < pending.job.parts.size() && staged < budget) {
    const BufferPart& part = pending.job.parts[pending.part];
    const std::uint64_t left = part.bytes.size() - pending.offset;
    const std::uint64_t count = budget - staged >= left ? left : std::min(left, (budget - staged + 3) / 4 * 4);
    auto slice = staged_slice(std::span(part.bytes).subspan(pending.offset, count));
    if (!slice.ok()) return slice.error();
    copies_.push_back({.from = *slice, .buffer = part.buffer, .offset = part.offset + pending.offset});
    staged += count;
    pending.offset += count;
    if (pending.offset < part.bytes.size()) continue;
    pending.offset = 0;
    ++pending.part;
  }
  return {};
}

Status AssetUploads::stage_texels(Pending& pending, std::uint64_t budget, std::uint64_t& staged) {
  const gpu::ImageDesc& desc = device_.desc(pending.job.image);
  std::uint64_t mip_begin = 0;
  for (std::uint32_t mip = 0; mip < pending.mip; ++mip) mip_begin += gpu::mip_bytes(desc, mip);
  while (pending.offset < pending.job.texels.size() && staged < budget) {
    const std::uint32_t height = std::max(desc.height >> pending.mip, 1u);
    const std::uint64_t row = gpu::mip_bytes(desc, pending.mip) / height;
    const auto first = static_cast<std::uint32_t>((pending.offset - mip_begin) / row);
    const auto rows = static_cast<std::uint32_t>(std::clamp<std::uint64_t>((budget - staged) / row, 1, height - first));
    auto slice = staged_slice(std::span(pending.job.texels).subspan(pending.offset, rows * row));
    if (!slice.ok()) return slice.error();
    Copy copy{.from = *slice, .image = pending.job.image, .mip = pending.mip, .first_row = first, .rows = rows};
    copy.first = pending.offset == 0;
    staged += rows * row;
    pending.offset += rows * row;
    copy.last = pending.offset == pending.job.texels.size();
    copies_.push_back(copy);
    if (first + rows == height) {
      mip_begin += gpu::mip_bytes(desc, pending.mip);
      ++pending.mip;
    }
  }
  return {};
}

Status AssetUploads::advance(Pending& pending, std::uint64_t budget, std::uint64_t& staged) {
  GLOAM_TRY(stage_parts(pending, budget, staged));
  if (pending.part == pending.job.parts.size() && pending.job.image) GLOAM_TRY(stage_texels(pending, budget, staged));
  return {};
}

Result<std::vector<std::uint64_t>> AssetUploads::stage(std::uint64_t budget) {
  copies_.clear();
  std::uint64_t staged = 0;
  for (Pending& pending : jobs_)
    if (pending.job.urgent)
      if (Status status = advance(pending, std::numeric_limits<std::uint64_t>::max(), staged); !status.ok())
        return status.error();
  for (Pending& pending : jobs_) {
    if (staged >= budget) break;
    if (Status status = advance(pending, budget, staged); !status.ok()) return status.error();
  }
  std::vector<std::uint64_t> finished;
  for (const Pending& pending : jobs_)
    if (done(pending)) finished.push_back(pending.job.number);
  std::erase_if(jobs_, [](const Pending& pending) { return done(pending); });
  if (jobs_.empty() && copies_.empty()) staging_.release();
  return finished;
}

void AssetUploads::record_barriers(gpu::CommandList& commands, std::span<const Target> targets, bool before) {
  std::vector<gpu::BufferBarrier> buffers;
  std::vector<gpu::ImageBarrier> images;
  std::vector<bool> seen(targets.size(), false);
  gpu::ImageHandle last_image;
  for (const Copy& copy : copies_) {
    if (copy.image) {
      const bool begins = copy.image != last_image;  // the copies of an image follow each other
      last_image = copy.image;
      const gpu::Access earlier = copy.first ? gpu::Access::none : gpu::Access::transfer_write;
      if (before && begins)
        images.push_back({.image = copy.image, .before = earlier, .after = gpu::Access::transfer_write});
      if (!before && copy.last)
        images.push_back(
            {.image = copy.image, .before = gpu::Access::transfer_write, .after = gpu::Access::fragment_read});
      continue;
    }
    if (seen[copy.buffer]) continue;
    seen[copy.buffer] = true;
    const Target& target = targets[copy.buffer];
    gpu::BufferBarrier barrier{.buffer = target.buffer};
    barrier.before = before ? target.access : gpu::Access::transfer_write;
    barrier.after = before ? gpu::Access::transfer_write : target.access;
    (before ? barrier.also_before : barrier.also_after) = target.also;
    buffers.push_back(barrier);
  }
  commands.barrier(buffers, images);
}

void AssetUploads::record(gpu::CommandList& commands, std::span<const Target> targets) {
  record_barriers(commands, targets, true);
  for (const Copy& copy : copies_) {
    if (copy.image)
      commands.copy_rows_to_image(copy.from.buffer, copy.from.offset, copy.image, copy.mip, copy.first_row, copy.rows);
    else
      commands.copy_buffer(copy.from.buffer, copy.from.offset, targets[copy.buffer].buffer, copy.offset,
                           copy.from.bytes.size());
  }
  record_barriers(commands, targets, false);
  copies_.clear();
}

void AssetUploads::clear() {
  jobs_.clear();
  copies_.clear();
  staging_.release();
}

std::uint64_t AssetUploads::bytes() const {
  std::uint64_t bytes = 0;
  for (const Pending& pending : jobs_) {
    bytes += pending.job.texels.size();
    for (std::size_t part = pending.part; part < pending.job.parts.size(); ++part)
      bytes += pending.job.parts[part].bytes.size();
    bytes -= pending.offset;
  }
  return bytes;
}

}  // namespace gloam
