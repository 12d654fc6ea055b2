// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam {

/// The scratch images that faces are drawn into: one depth array per face size, all in the same memory, so only one of
/// them holds data at a time. The frame graph does not track them: if it did, each different set of drawn faces would
/// need another frame-graph plan. Memory: 4 bytes per texel, that is 4 MiB (kScratchTexels) with faces of up to 1024²
/// texels, 64 MiB when a face has a side of kMostFace texels, and 16 MiB for maps outside the standard atlas.
class ShadowScratch {
 public:
  /// Makes room for a batch of faces of one size with `texels` texels together. May replace all images, so call it
  /// before the frame's commands are recorded. Memory grows only.
  [[nodiscard]] Status reserve(gpu::Device& device, std::uint64_t texels);
  /// The array for faces of this size. size: texels of a side, a power of two; size² texels must be reserved.
  [[nodiscard]] gpu::ImageHandle image(std::uint32_t size) const;
  /// Destroys all images.
  void release(gpu::Device& device);
  [[nodiscard]] std::uint64_t texels() const { return texels_; }

  /// Barriers of image(size). begin_drawing: between any earlier use of the memory and draws into its layers.
  /// begin_reading: between these draws and reads by compute shaders.
  void begin_drawing(gpu::CommandList& commands, std::uint32_t size) const;
  void begin_reading(gpu::CommandList& commands, std::uint32_t size) const;

 private:
  std::vector<gpu::ImageHandle> images_;  ///< by size, from GLOAM_SHADOW_SMALLEST_FACE up, each twice the one before
  std::uint64_t texels_ = 0;
};

}  // namespace gloam
