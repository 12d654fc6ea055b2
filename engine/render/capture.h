// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Bytes of an image, read back at once.
struct Capture {
  gpu::BufferHandle buffer;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t texel_bytes = 0;
};

/// Declares a copy of an image's first mip and layer into a readback buffer.
[[nodiscard]] Result<Capture> capture_image(FrameGraph& graph, gpu::Device& device, ImageRef image);

/// The bytes after the frame has ended; destroys the buffer.
[[nodiscard]] std::vector<std::byte> take_capture(gpu::Device& device, const Capture& capture);

/// Copies an image that is ready for Access::transfer_read, in a frame of its own, and waits.
[[nodiscard]] Result<std::vector<std::byte>> read_image_now(gpu::Device& device, gpu::ImageHandle image);

}  // namespace gloam
