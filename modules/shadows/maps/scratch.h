// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam {

/// The depth images that faces are drawn into: an array for each size of a face, all in the same memory, so one of them
/// at a time holds something. The frame graph does not know them: frames that draw other faces would be other frames to
/// it. Memory: 4 bytes a texel, that is 16 MiB (kScratchTexels), or 64 MiB where a face has kMostFace texels.
class ShadowScratch {
 public:
  /// Makes room for faces of so many texels together, all of one size. Not between frames' recording; what is there
  /// only grows.
  [[nodiscard]] Status reserve(gpu::Device& device, std::uint64_t texels);
  /// For faces of this side in texels, a power of two that reserve has heard of.
  [[nodiscard]] gpu::ImageHandle image(std::uint32_t size) const;
  void release(gpu::Device& device);
  [[nodiscard]] std::uint64_t texels() const { return texels_; }

  /// Before its layers are drawn, whatever was done with the memory before; and before they are read by compute
  /// shaders.
  void begin_drawing(gpu::CommandList& commands, std::uint32_t size) const;
  void begin_reading(gpu::CommandList& commands, std::uint32_t size) const;

 private:
  std::vector<gpu::ImageHandle> images_;  ///< by size, from GLOAM_SHADOW_SMALLEST_FACE up
  std::uint64_t texels_ = 0;
};

}  // namespace gloam
