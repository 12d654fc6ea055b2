// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Readback buffer for a copy of an image or a buffer.
struct Capture {
  gpu::BufferHandle buffer;
  std::uint32_t width = 0;  ///< 0 for a buffer
  std::uint32_t height = 0;
  std::uint32_t texel_bytes = 0;
};

/// Declares a copy of an image's first mip and layer into a readback buffer.
[[nodiscard]] Result<Capture> capture_image(FrameGraph& graph, gpu::Device& device, ImageRef image);

/// Declares a copy of a whole buffer into a readback buffer. A buffer that is owned outside the graph must have been
/// created as a transfer_source.
[[nodiscard]] Result<Capture> capture_buffer(FrameGraph& graph, gpu::Device& device, BufferRef buffer);

/// Returns the copied bytes and destroys the readback buffer. The frame must have ended on the GPU.
[[nodiscard]] std::vector<std::byte> take_capture(gpu::Device& device, const Capture& capture);

/// Readback copies of one frame, by name.
class Captures {
 public:
  explicit Captures(gpu::Device& device) : device_(device) {}
  ~Captures();
  Captures(const Captures&) = delete;
  Captures& operator=(const Captures&) = delete;

  /// Declares a copy of an image's first mip and layer, or of a whole buffer. Names must differ (asserted).
  [[nodiscard]] Status add(FrameGraph& graph, std::string_view name, ImageRef image);
  [[nodiscard]] Status add(FrameGraph& graph, std::string_view name, BufferRef buffer);

  /// Reads all copies to the CPU. The frame must have ended on the GPU.
  void finish();
  /// The bytes of a finished copy; empty if there is no copy of that name.
  [[nodiscard]] std::span<const std::byte> bytes(std::string_view name) const;
  /// Item `index` of a finished copy that holds items of type T.
  template <class T>
  [[nodiscard]] T item(std::string_view name, std::size_t index) const {
    T value;
    copy_item(name, index * sizeof(T), std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }

 private:
  void copy_item(std::string_view name, std::size_t offset, std::span<std::byte> target) const;

  gpu::Device& device_;
  std::map<std::string, Capture, std::less<>> open_;
  std::map<std::string, std::vector<std::byte>, std::less<>> done_;
};

/// Reads an image that is ready for Access::transfer_read. Submits a separate frame for it and waits for the GPU.
[[nodiscard]] Result<std::vector<std::byte>> read_image_now(gpu::Device& device, gpu::ImageHandle image);

}  // namespace gloam
