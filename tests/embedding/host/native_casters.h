// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/math/types.h"
#include "engine/math/world_box.h"
#include "engine/render/module.h"
#include "shaders/render/caster_shared.h"
#include "vulkan_host.h"

namespace host {

/// A mesh of the host's with two bones. Positions are in the world.
struct SkinnedMesh {
  std::vector<gloam::vec4> rest;  ///< xyz: position at rest; w: weight of the second bone
  std::vector<std::uint32_t> indices;
  std::array<gloam::mat4, 2> bones = {gloam::mat4(1.0f), gloam::mat4(1.0f)};
  /// To be raised whenever the bones change. 0: the host does not tell when they change.
  std::uint64_t revision = 1;

  /// A column of square rings.
  [[nodiscard]] static SkinnedMesh column(const gloam::vec3& foot, float height_m, float half_m, std::uint32_t rings);
  /// Turns the upper bone about the middle of the column.
  void bend(float radians);
  [[nodiscard]] std::vector<gloam::vec3> posed() const;
  /// margin_m: for the rounding of the GPU.
  [[nodiscard]] gloam::WorldBox bounds(double margin_m = 1e-5) const;
};

/// Cubes: xyz: centre in the world; w: half size.
using Cubes = std::vector<gloam::vec4>;
[[nodiscard]] gloam::WorldBox bounds_of(std::span<const gloam::vec4> cubes);

/// The Vulkan objects with which the host draws both into shadow maps: buffers, descriptors, layouts and pipelines of
/// its own. gloam knows none of them but the buffer of posed vertices, which is imported.
class NativeDrawing {
 public:
  NativeDrawing(VulkanHost& vulkan, gloam::gpu::Device& device, const SkinnedMesh& mesh, const Cubes& cubes);
  /// The GPU must have finished all frames with these objects.
  ~NativeDrawing();
  NativeDrawing(const NativeDrawing&) = delete;
  NativeDrawing& operator=(const NativeDrawing&) = delete;

  /// Records the skinning outside of rendering: writes the bones, then the posed vertices.
  void record_skinning(VkCommandBuffer commands, const std::array<gloam::mat4, 2>& bones) const;
  /// What both draws need from gloam.
  struct Face {
    gloam::shaders::CasterConstants constants;
    float bias_units = 0.0f;
    float bias_slope = 0.0f;
  };
  void record_mesh(VkCommandBuffer commands, const Face& face) const;
  void record_cubes(VkCommandBuffer commands, const Face& face) const;
  /// gloam's handle of the posed vertices.
  [[nodiscard]] gloam::gpu::BufferHandle posed() const { return posed_handle_; }

 private:
  void make_layouts();
  void make_descriptors();
  [[nodiscard]] VkShaderModule make_module(const gloam::gpu::ShaderCode& code) const;
  [[nodiscard]] VkPipeline make_skinning() const;
  [[nodiscard]] VkPipeline make_caster(const gloam::gpu::ShaderCode& code, VkFormat format, std::uint32_t stride,
                                       VkVertexInputRate rate) const;
  void begin_draw(VkCommandBuffer commands, VkPipeline pipeline, const Face& face) const;

  VulkanHost& vulkan_;
  gloam::gpu::Device& device_;
  std::uint32_t vertices_, indices_, cubes_;
  HostBuffer rest_buffer_, bones_buffer_, posed_buffer_, index_buffer_, cube_buffer_;
  gloam::gpu::BufferHandle posed_handle_;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout skinning_layout_ = VK_NULL_HANDLE, caster_layout_ = VK_NULL_HANDLE;
  VkPipeline skinning_ = VK_NULL_HANDLE, mesh_pipeline_ = VK_NULL_HANDLE, cube_pipeline_ = VK_NULL_HANDLE;
};

/// How often gloam has asked the host to record, and what else the host records.
struct NativeCounts {
  int skinned = 0;
  int mesh_draws = 0;
  int cube_draws = 0;
  bool works = false;                     ///< a pass of the host records in every frame
  std::optional<std::uint64_t> revision;  ///< of that pass, as in native_commands
};

/// A module that adds both as caster sources. All arguments outlive it.
[[nodiscard]] std::unique_ptr<gloam::Module> make_native_casters(const NativeDrawing& drawing, const SkinnedMesh& mesh,
                                                                 const Cubes& cubes, NativeCounts& counts);

}  // namespace host
