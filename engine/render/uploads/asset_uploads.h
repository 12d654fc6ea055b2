// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/transfers/staging.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Copies to the scene's buffers and to images that are spread over frames, oldest first: stage() fills staging memory
/// for one frame, record() records the copies. Nothing waits for the GPU.
class AssetUploads {
 public:
  /// Bytes for one of the scene's buffers.
  struct BufferPart {
    std::uint32_t buffer = 0;  ///< index into the span that record() takes
    std::uint64_t offset = 0;  ///< in bytes
    std::vector<std::byte> bytes;
  };
  /// Copies whose results become visible together.
  struct Job {
    std::uint64_t number = 0;  ///< the caller's
    std::vector<BufferPart> parts;
    gpu::ImageHandle image;         ///< RGBA8 with all its mips; null: none
    std::vector<std::byte> texels;  ///< of all mips, tightly packed
    bool urgent = false;            ///< staged in the next frame, also beyond the budget
  };

  explicit AssetUploads(gpu::Device& device) : device_(device) {}

  void add(Job job);
  /// Drops what is left of a job. Between record() and stage().
  void cancel(std::uint64_t number);
  /// Stages at most `budget` bytes of the jobs, but at least one row of texels if any are left, and all urgent jobs.
  /// Call it once a frame, after Device::begin_frame. Returns the numbers of the jobs whose last bytes are staged now.
  [[nodiscard]] Result<std::vector<std::uint64_t>> stage(std::uint64_t budget);
  /// Whether record() has copies to record.
  [[nodiscard]] bool has_copies() const { return !copies_.empty(); }
  /// Records what stage() has staged. before, after: of the buffers, see gpu::BufferBarrier; images are left ready for
  /// fragment_read.
  struct Target {
    gpu::BufferHandle buffer;
    gpu::Access access = gpu::Access::none;  ///< made before the copies and after them
    gpu::AccessMask also = 0;
  };
  void record(gpu::CommandList& commands, std::span<const Target> targets);
  /// Drops everything, and frees staging memory.
  void clear();

  [[nodiscard]] std::uint64_t bytes() const;  ///< that are not staged yet

 private:
  struct Pending {
    Job job;
    std::size_t part = 0;      ///< the next part of the buffers; after the last: texels
    std::uint64_t offset = 0;  ///< in the part; in the texels
    std::uint32_t mip = 0;     ///< of the texel at `offset`
  };
  struct Copy {
    UploadSlice from;
    std::uint32_t buffer = 0;
    std::uint64_t offset = 0;
    gpu::ImageHandle image;
    std::uint32_t mip = 0;
    std::uint32_t first_row = 0;
    std::uint32_t rows = 0;
    bool first = false;  ///< of its image
    bool last = false;
  };
  [[nodiscard]] Status advance(Pending& pending, std::uint64_t budget, std::uint64_t& staged);
  [[nodiscard]] Status stage_parts(Pending& pending, std::uint64_t budget, std::uint64_t& staged);
  [[nodiscard]] Status stage_texels(Pending& pending, std::uint64_t budget, std::uint64_t& staged);
  [[nodiscard]] Result<UploadSlice> staged_slice(std::span<const std::byte> bytes);
  [[nodiscard]] static bool done(const Pending& pending);
  void record_barriers(gpu::CommandList& commands, std::span<const Target> targets, bool before);

  gpu::Device& device_;
  Staging staging_{"engine"};
  std::deque<Pending> jobs_;
  std::vector<Copy> copies_;
};

}  // namespace gloam
