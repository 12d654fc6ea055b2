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

/// Factor from cd/m² to units in which 1 is white before the tone curve, for an exposure value at ISO 100.
[[nodiscard]] float exposure_from_ev100(float ev100);

/// The module's number for this world; a resource of the world. The address of the world would not be unique: a
/// reloaded scene may get the address of the old one, but must not get its exposure.
struct LightingWorld {
  std::uint64_t number = 0;
};

/// Metered exposures on the GPU, one slot per world, view and camera: metered in the camera's first frame, then fixed.
class ExposureSlots {
 public:
  static constexpr std::uint32_t kCapacity = 1024;

  struct Slot {
    std::uint32_t index = 0;
    bool fresh = false;  ///< must be metered in this frame
  };

  /// Call it in every frame, before slot_of. Creates the buffer on the first call; fails if the device cannot. `device`
  /// must live until release().
  [[nodiscard]] Status prepare(gpu::Device& device);
  /// Forgets the slots that were first given in this frame (Device::frame_number), which were never metered.
  void give_up_frame(std::uint64_t frame);
  /// Destroys the buffer and forgets all slots.
  void release();
  [[nodiscard]] gpu::BufferHandle buffer() const { return buffer_; }
  /// The buffer in the frame's graph, imported by the frame's first call. A pass that writes the buffer must assign the
  /// new version to the returned reference, so that the next view continues from it.
  [[nodiscard]] BufferRef& in(FrameGraph& graph);
  /// The slot of a camera in a world. If all slots are in use, takes the oldest one; its camera is metered again when
  /// it returns.
  [[nodiscard]] Slot slot_of(LightingWorld world, const RenderView& view);

 private:
  gpu::Device* device_ = nullptr;
  gpu::BufferHandle buffer_;
  BufferRef imported_;
  using Key = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t,
                         std::uint32_t>;  // world, view, camera's index and generation
  struct Kept {
    std::uint32_t index = 0;
    std::uint64_t frame = 0;  ///< Device::frame_number of the frame that meters it
  };
  std::map<Key, Kept> slots_;
  std::uint32_t next_ = 0;
  std::uint64_t frame_ = 0;  ///< Device::frame_number of the last prepare()
};

}  // namespace gloam
