// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// One compute pipeline with its resources of set 0: add inputs and outputs, run it, read the outputs. Outputs are
/// filled with words of kUntouched, so that a check sees which words the kernel did not write. The first error is kept
/// (status), and what comes after it does nothing.
class KernelRun {
 public:
  static constexpr std::uint32_t kUntouched = 0xA5A5A5A5u;

  KernelRun(const KernelLab& lab, const gpu::ShaderCode& shader, gpu::SpecConstants constants = {});
  ~KernelRun();
  KernelRun(const KernelRun&) = delete;
  KernelRun& operator=(const KernelRun&) = delete;

  [[nodiscard]] const Status& status() const { return status_; }

  /// A storage or uniform buffer with these items (at least one).
  template <class T>
  void input(std::uint32_t binding, const std::vector<T>& items) {
    input_bytes(binding, std::as_bytes(std::span(items)));
  }
  /// A storage buffer to be read back.
  void output(std::uint32_t binding, std::uint64_t bytes);
  /// A storage buffer with these items that the kernel changes, to be read back.
  template <class T>
  void in_out(std::uint32_t binding, const std::vector<T>& items) {
    in_out_bytes(binding, std::as_bytes(std::span(items)));
  }
  /// An image without mips whose texels the kernel fetches.
  template <class T>
  void sampled_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                     const std::vector<T>& texels, gpu::ImageShape shape = gpu::ImageShape::plain) {
    sampled_bytes(binding, format, width, height, std::as_bytes(std::span(texels)), shape);
  }
  /// An image that the caller owns, ready for compute_read.
  void sampled_image(std::uint32_t binding, gpu::ImageHandle image, gpu::Filter filter = gpu::Filter::nearest);
  /// A storage image to be read back, row by row.
  void output_image(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                    bool as_array = false);
  template <class T>
  void push(const T& constants) {
    const auto bytes = std::as_bytes(std::span(&constants, 1));
    constants_.assign(bytes.begin(), bytes.end());
  }

  /// Runs the pipeline once and waits.
  [[nodiscard]] Status run(std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1);
  /// The contents of an output after run().
  template <class T>
  [[nodiscard]] std::vector<T> read(std::uint32_t binding) const {
    const std::span<const std::byte> bytes = bytes_of(binding);
    std::vector<T> items(bytes.size() / sizeof(T));
    if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
    return items;
  }

 private:
  void input_bytes(std::uint32_t binding, std::span<const std::byte> bytes);
  void in_out_bytes(std::uint32_t binding, std::span<const std::byte> bytes);
  void sampled_bytes(std::uint32_t binding, gpu::Format format, std::uint32_t width, std::uint32_t height,
                     std::span<const std::byte> texels, gpu::ImageShape shape);
  [[nodiscard]] std::span<const std::byte> bytes_of(std::uint32_t binding) const;
  [[nodiscard]] gpu::BufferHandle make_buffer(std::uint64_t bytes, gpu::BufferUsage usage, gpu::MemoryKind memory);
  [[nodiscard]] gpu::ImageHandle make_image(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                            gpu::ImageUsage usage, gpu::ImageShape shape);
  void record(gpu::CommandList& commands, std::uint32_t x, std::uint32_t y, std::uint32_t z);
  /// Keeps the first error. Whether there is none.
  template <class T>
  bool keep(const Result<T>& result) {
    if (status_.ok() && !result.ok()) status_ = result.error();
    return status_.ok();
  }

  gpu::Device& device_;
  Status status_;
  gpu::PipelineHandle pipeline_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::ImageHandle> images_;
  std::vector<gpu::Binding> bindings_;
  std::map<std::uint32_t, gpu::BufferHandle> results_;
  std::vector<std::pair<gpu::ImageHandle, gpu::BufferHandle>> image_results_;
  std::vector<std::byte> constants_;
};

}  // namespace gloam
