// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/gpu/vulkan/api.h"
#include "engine/gpu/vulkan/compile/pipelines.h"

namespace gloam::gpu::vulkan {

/// The pipeline, descriptors and buffers that the commands of a frame have bound so far. Asserts that draws and
/// dispatches are recorded where Vulkan allows them, with everything bound that their pipeline uses: otherwise a driver
/// would read through null pointers.
class BoundState {
 public:
  /// Call it when a frame begins.
  void start() { *this = {}; }
  void bind_pipeline(const Pipeline& pipeline);
  /// For the bound pipeline.
  void bind_set(std::uint32_t set);
  void bind_vertex_stream(std::uint32_t stream);
  void bind_indices();
  void begin_rendering();
  void end_rendering();
  [[nodiscard]] bool rendering() const { return rendering_; }
  /// The host records into the same command buffer (native_commands). Afterwards nothing is bound.
  void begin_native();
  void end_native();
  [[nodiscard]] bool native() const { return native_; }
  /// `pipelines`: for the sentence.
  void check_dispatch(const Pipelines& pipelines, PipelineHandle pipeline) const;
  void check_draw(const Pipelines& pipelines, PipelineHandle pipeline, bool indexed) const;
  /// Asserts that the host is not recording. command: "a copy".
  void check_own(std::string_view command) const;
  /// Asserts the same, and that a command does not come inside rendering.
  void check_outside(std::string_view command) const;

 private:
  void check_sets(const Pipelines& pipelines, PipelineHandle pipeline) const;
  [[nodiscard]] const std::vector<VkDescriptorSetLayout>& sets() const { return bound_[draws_ ? 1 : 0]; }

  const PipelineLayout* layout_ = nullptr;  ///< of the bound pipeline, like the next three
  bool draws_ = false;
  std::uint32_t used_sets_ = 0;
  std::uint32_t vertex_streams_ = 0;
  std::array<std::vector<VkDescriptorSetLayout>, 2> bound_;  ///< layouts of bound sets: of dispatches, of draws
  std::uint32_t streams_ = 0;                                ///< bit i: stream i is bound
  bool indices_ = false;
  bool rendering_ = false;
  bool native_ = false;  ///< the host is recording
};

}  // namespace gloam::gpu::vulkan
