// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/device.h"
#include "engine/gpu/vulkan/binding/descriptor_pool.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// Descriptor sets that live for one frame: set 0 of each pipeline where it is not pushed. Each frame in flight has its
/// own pools, which are reset when the frame is begun again. A pool is added when the existing ones are full. Used on
/// the thread that records.
class FrameSets {
 public:
  explicit FrameSets(Context& context) : context_(context) {}
  ~FrameSets();
  FrameSets(const FrameSets&) = delete;
  FrameSets& operator=(const FrameSets&) = delete;

  /// Frees the sets of the frame that used these pools before; the GPU must have finished it. `frame`: the number of
  /// the frame that begins.
  void begin(std::uint64_t frame);
  /// A set for the frame that was begun last. bindings: those of the layout.
  [[nodiscard]] Result<VkDescriptorSet> allocate(VkDescriptorSetLayout layout,
                                                 std::span<const ReflectedBinding> bindings);
  /// The number of pools of all frames.
  [[nodiscard]] std::size_t pool_count() const;

  static constexpr std::uint32_t kSetsPerPool = 256;

 private:
  struct Pool {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::uint32_t most_sets = 0;
    DescriptorCounts most = {};
    std::uint32_t sets = 0;  ///< allocated since the last reset
    DescriptorCounts used = {};
    [[nodiscard]] bool has_room_for(const DescriptorCounts& more) const;
  };
  struct Slot {
    std::vector<Pool> pools;
    std::size_t current = 0;  ///< pools before this one are full
  };

  [[nodiscard]] VkResult add_pool(Slot& slot, const DescriptorCounts& least);

  Context& context_;
  std::array<Slot, Device::kFramesInFlight> slots_;
  std::size_t frame_slot_ = 0;
};

}  // namespace gloam::gpu::vulkan
