// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/render/view.h"

namespace gloam {

/// Factor from cd/m² to 1 = white before the curve, for an exposure value at ISO 100.
[[nodiscard]] float exposure_from_ev100(float ev100);

/// Number of a world among those a lighting module has prepared; a resource of the world. An address would not do: a
/// scene that is loaded again may get the old one's, but not its exposure.
struct LightingWorld {
  std::uint64_t number = 0;
};

/// Metered exposures on the GPU, one slot a world, view and camera: metered in the camera's first frame, then fixed.
class ExposureSlots {
 public:
  static constexpr std::uint32_t kCapacity = 1024;

  struct Slot {
    std::uint32_t index = 0;
    bool fresh = false;  ///< must be metered in this frame
  };

  [[nodiscard]] Status prepare(gpu::Device& device);
  void release();
  [[nodiscard]] gpu::BufferHandle buffer() const { return buffer_; }
  /// The buffer in the frame being declared: one import for all its views, and the version the last of them left.
  [[nodiscard]] BufferRef& in(FrameGraph& graph);
  /// The slot of a camera of a world; when all are taken, the oldest camera's is metered anew.
  [[nodiscard]] Slot slot_of(LightingWorld world, const RenderView& view);

 private:
  gpu::Device* device_ = nullptr;
  gpu::BufferHandle buffer_;
  BufferRef imported_;
  using Key = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t,
                         std::uint32_t>;  // world, view, camera's index and generation
  std::map<Key, std::uint32_t> slots_;
  std::uint32_t next_ = 0;
};

}  // namespace gloam
