// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/jobs/executor.h"

namespace gloam {

/// A stretch of a mapped upload buffer, valid until the frame it was taken in has ended on the GPU.
struct UploadSlice {
  gpu::BufferHandle buffer;
  std::uint64_t offset = 0;
  std::span<std::byte> bytes;
};

/// Per-frame scratch memory the CPU writes and the GPU reads: one growing ring a frame in flight. Alignment 256 bytes.
class UploadRing {
 public:
  UploadRing(gpu::Device& device, std::string module, gpu::BufferUsage usage, std::uint64_t first_bytes = 1 << 20);
  ~UploadRing();
  UploadRing(const UploadRing&) = delete;
  UploadRing& operator=(const UploadRing&) = delete;

  /// After Device::begin_frame: forgets what this frame's slot held.
  void begin_frame();
  [[nodiscard]] Result<UploadSlice> allocate(std::uint64_t bytes);
  /// Allocates and copies; gives the binding for it.
  [[nodiscard]] Result<gpu::Binding::BufferRange> write(std::span<const std::byte> data);
  template <class T>
  [[nodiscard]] Result<gpu::Binding::BufferRange> write_value(const T& value) {
    return write(std::as_bytes(std::span(&value, 1)));
  }

 private:
  struct Slot {
    std::vector<gpu::BufferHandle> blocks;
    std::vector<std::uint64_t> sizes;
    std::size_t block = 0;
    std::uint64_t used = 0;
  };
  gpu::Device& device_;
  std::string module_;
  gpu::BufferUsage usage_;
  std::uint64_t first_bytes_;
  std::vector<Slot> slots_;
};

/// Fills device buffers and images once (meshes, textures): stages, submits frames of its own and waits. Not for
/// per-frame use.
class Uploader {
 public:
  /// Writes every byte of the staging memory it is given, which may be slow to read. Runs in a job.
  using Fill = std::function<void(std::span<std::byte>)>;

  explicit Uploader(gpu::Device& device) : device_(device) {}
  void buffer(gpu::BufferHandle target, std::vector<std::byte> bytes, gpu::Access after);
  /// All mips of all layers, tightly packed, layer by layer and inside a layer mip by mip.
  void image(gpu::ImageHandle target, std::vector<std::byte> texels, gpu::Access after);
  /// The same, made in staging memory when its turn comes.
  void image(gpu::ImageHandle target, Fill fill, gpu::Access after);
  /// Does all that was asked for since the last call; not between begin_frame and submit_frame. One upload a target and
  /// call. After a fault nothing of it is tried again.
  [[nodiscard]] Status flush();
  /// The same, filling in jobs.
  [[nodiscard]] Status flush(JobExecutor& executor);

 private:
  struct Job {
    gpu::BufferHandle buffer;
    gpu::ImageHandle image;
    Fill fill;
    std::uint64_t size = 0;
    gpu::Access after = gpu::Access::none;
  };
  /// Jobs that one frame copies from one staging buffer.
  struct Batch {
    std::span<const Job> jobs;
    std::uint64_t bytes = 0;
  };
  void add_image(gpu::ImageHandle target, std::uint64_t size, Fill fill, gpu::Access after);
  [[nodiscard]] static std::vector<Batch> batches_of(std::span<const Job> jobs);
  [[nodiscard]] Status submit(std::span<const Batch> batches, std::span<const gpu::BufferHandle> staging,
                              JobExecutor& executor);
  void record(gpu::CommandList& commands, std::span<const Job> jobs, gpu::BufferHandle staging);

  gpu::Device& device_;
  std::vector<Job> jobs_;
};

}  // namespace gloam
