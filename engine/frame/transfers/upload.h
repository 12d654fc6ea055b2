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

/// A range of a mapped upload buffer, valid until the frame it was allocated in has finished on the GPU.
struct UploadSlice {
  gpu::BufferHandle buffer;
  std::uint64_t offset = 0;
  std::span<std::byte> bytes;
};

/// Per-frame scratch memory that the CPU writes and the GPU reads: one growing set of buffers per frame in flight.
/// Slices are aligned to 256 bytes.
class UploadRing {
 public:
  /// Memory is accounted to `module`. `usage`: usage flags of the buffers. `first_bytes`: size of the first buffer of
  /// each frame in flight.
  UploadRing(gpu::Device& device, std::string module, gpu::BufferUsage usage, std::uint64_t first_bytes = 1 << 20);
  ~UploadRing();
  UploadRing(const UploadRing&) = delete;
  UploadRing& operator=(const UploadRing&) = delete;

  /// Call it after Device::begin_frame. Frees the slices that were allocated Device::kFramesInFlight frames ago.
  void begin_frame();
  /// bytes: > 0. Fails if the device cannot create a further buffer.
  [[nodiscard]] Result<UploadSlice> allocate(std::uint64_t bytes);
  /// Allocates a slice, copies the data to it and returns its binding.
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

/// Uploads data to device buffers and images once (meshes, textures): fills staging buffers, submits its own frames and
/// waits for them. Not for per-frame use.
class Uploader {
 public:
  /// Must write every byte of the staging memory it is given, which may be slow to read. Runs in a job.
  using Fill = std::function<void(std::span<std::byte>)>;

  explicit Uploader(gpu::Device& device) : device_(device) {}
  /// Requests an upload of `bytes` (1 to the size of the buffer) to the start of the buffer. `after`: the access that
  /// the target is left ready for, here and below; also_after: further ones.
  void buffer(gpu::BufferHandle target, std::vector<std::byte> bytes, gpu::Access after,
              gpu::AccessMask also_after = 0);
  /// texels: all mips of all layers, tightly packed, layer by layer and within a layer mip by mip.
  void image(gpu::ImageHandle target, std::vector<std::byte> texels, gpu::Access after);
  /// The same, but `fill` writes the texels to staging memory during flush.
  void image(gpu::ImageHandle target, Fill fill, gpu::Access after);
  /// Executes all uploads that were requested since the last call, and waits for them. Must not be called between
  /// begin_frame and submit_frame. At most one upload per target and call. If an error is returned, the requests are
  /// dropped and not tried again.
  [[nodiscard]] Status flush();
  /// The same, but staging memory is filled by jobs of `executor`. If a job throws, the requests are dropped and the
  /// exception is rethrown.
  [[nodiscard]] Status flush(JobExecutor& executor);

 private:
  struct Job {
    gpu::BufferHandle buffer;
    gpu::ImageHandle image;
    Fill fill;
    std::uint64_t size = 0;
    gpu::Access after = gpu::Access::none;
    gpu::AccessMask also_after = 0;
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
