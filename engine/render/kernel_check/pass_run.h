// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/declare/pass_frames.h"
#include "engine/render/kernel_check/kernel_lab.h"

namespace gloam {

/// PassFrames whose inputs are vectors and whose results are read back. Without draws, so they run at every vector
/// width of lavapipe. The first error is kept (status), and what comes after it does nothing.
class PassRun {
 public:
  /// view: of all frames.
  explicit PassRun(const KernelLab& lab, const RenderView& view = {});
  ~PassRun();
  PassRun(const PassRun&) = delete;
  PassRun& operator=(const PassRun&) = delete;

  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] KnobRegistry& knobs() { return frames_.knobs(); }

  /// Before draw(): an image without mips with these texels, for input(). Passes may sample and write it.
  template <class T>
  [[nodiscard]] gpu::ImageHandle make_image(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                            const std::vector<T>& texels) {
    return make_image_of(format, width, height, std::as_bytes(std::span(texels)));
  }
  /// Draws a frame with the passes that declare(FrameBuilder&) adds, and waits for it.
  Status draw(const std::function<void(FrameBuilder&)>& declare);
  /// In declare(): a buffer of the frame with these items (at least one).
  template <class T>
  [[nodiscard]] BufferRef input(const std::string& name, const std::vector<T>& items) {
    return input_bytes(name, std::as_bytes(std::span(items)));
  }
  /// In declare(): an image of make_image().
  [[nodiscard]] ImageRef input(const std::string& name, gpu::ImageHandle image);
  /// In declare(): keeps the first `bytes` of a buffer for read(). buffer: the version that no later pass writes.
  void keep(FrameBuilder& frame, const std::string& name, BufferRef buffer, std::uint64_t bytes);
  /// In declare(): keeps the first mip and layer of an image for read(), row by row.
  void keep(const std::string& name, ImageRef image);
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& name) const {
    const std::span<const std::byte> bytes = bytes_of(name);
    std::vector<T> items(bytes.size() / sizeof(T));
    if (!items.empty()) std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
    return items;
  }

 private:
  [[nodiscard]] gpu::ImageHandle make_image_of(gpu::Format format, std::uint32_t width, std::uint32_t height,
                                               std::span<const std::byte> texels);
  [[nodiscard]] BufferRef input_bytes(const std::string& name, std::span<const std::byte> bytes);
  [[nodiscard]] std::span<const std::byte> bytes_of(const std::string& name) const;
  [[nodiscard]] Result<gpu::BufferHandle> make_buffer(std::uint64_t bytes, gpu::BufferUsage usage,
                                                      gpu::MemoryKind memory);
  /// Keeps the first error. Whether there is none.
  template <class T>
  bool noted(const Result<T>& result) {
    if (status_.ok() && !result.ok()) status_ = result.error();
    return status_.ok();
  }

  gpu::Device& device_;
  Status status_;
  PassFrames frames_;
  std::vector<gpu::BufferHandle> buffers_;
  std::vector<gpu::ImageHandle> images_;
  std::map<std::string, gpu::BufferHandle> kept_;
};

}  // namespace gloam
