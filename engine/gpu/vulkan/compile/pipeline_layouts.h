// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/spirv/reflection.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

/// The resources and push constants that all stages of a pipeline declare.
struct ShaderInterface {
  std::vector<ReflectedBinding> bindings;  ///< ordered by set, then binding; each pair occurs once
  std::uint32_t push_constant_bytes = 0;
  [[nodiscard]] std::span<const ReflectedBinding> of_set(std::uint32_t set) const;
  [[nodiscard]] std::uint32_t set_count() const { return bindings.empty() ? 0 : bindings.back().set + 1; }
};

/// Fails with ErrorKind::failed if two stages declare a binding differently, the engine cannot bind a resource, or a
/// device limit is exceeded.
[[nodiscard]] Result<ShaderInterface> merge_stages(const Context& context, std::string_view pipeline,
                                                   std::span<const SpirvReflection> stages);

struct PipelineLayout {
  VkPipelineLayout layout = VK_NULL_HANDLE;
  std::vector<VkDescriptorSetLayout> sets;
  bool pushes_set_0 = false;  ///< with push descriptors; otherwise in descriptor sets of FrameSets
};

/// Pipeline layouts and set layouts by content. They live as long as the device. Equal sets of two pipelines get one
/// layout, so a resource set fits both pipelines; for the same reason every binding is visible to all stages. Set 0 is
/// pushed if the device has push descriptors and enough of them. Thread-safe.
class PipelineLayouts {
 public:
  explicit PipelineLayouts(Context& context) : context_(context) {}
  ~PipelineLayouts();

  /// The pointer stays valid as long as this object.
  [[nodiscard]] Result<const PipelineLayout*> find_or_create(const ShaderInterface& shader);

 private:
  using BindingKey = std::tuple<std::uint32_t, ResourceKind, std::uint32_t>;
  using SetKey = std::pair<bool, std::vector<BindingKey>>;  // whether it is pushed; its bindings
  using LayoutKey = std::pair<std::vector<VkDescriptorSetLayout>, std::uint32_t>;

  Result<VkDescriptorSetLayout> set_layout(std::span<const ReflectedBinding> bindings, bool pushed);

  Context& context_;
  std::mutex mutex_;
  std::map<SetKey, VkDescriptorSetLayout> set_layouts_;
  std::map<LayoutKey, PipelineLayout> layouts_;
};

}  // namespace gloam::gpu::vulkan
