// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/compile/pipelines.h"
#include "engine/gpu/vulkan/resources/buffers.h"
#include "engine/gpu/vulkan/resources/images.h"
#include "engine/gpu/vulkan/resources/samplers.h"

namespace gloam::gpu::vulkan {

/// Converts bindings to descriptor writes for one set of a pipeline. The elements of an array binding are given in
/// order, as bindings with the same number. Bindings that the shader does not declare are ignored. Bindings that the
/// shader declares but never uses may be missing.
class DescriptorWriter {
 public:
  DescriptorWriter(const Context& context, const Buffers& buffers, Images& images, const Samplers& samplers)
      : context_(context), buffers_(buffers), images_(images), samplers_(samplers) {}

  /// The layout to write for sampled images. as_recorded: the layout that the barriers recorded so far left them in.
  /// read_only: the read-only layout, which they must be in when the set is used.
  enum class Layouts : std::uint8_t { as_recorded, read_only };

  /// The returned writes point into this object and stay valid until the next call.
  [[nodiscard]] Result<std::span<const VkWriteDescriptorSet>> build(const Pipeline& pipeline, std::uint32_t set,
                                                                    std::span<const Binding> bindings,
                                                                    VkDescriptorSet target, Layouts layouts);

 private:
  [[nodiscard]] Status add(const ReflectedBinding& slot, const Binding& binding, Layouts layouts);
  void add_buffer(const ReflectedBinding& slot, const Binding::BufferRange& range);
  [[nodiscard]] Status add_image(const ReflectedBinding& slot, const ImageView& view, VkSampler sampler,
                                 Layouts layouts);

  const Context& context_;
  const Buffers& buffers_;
  Images& images_;
  const Samplers& samplers_;
  std::vector<VkDescriptorBufferInfo> buffer_infos_;
  std::vector<VkDescriptorImageInfo> image_infos_;
  std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace gloam::gpu::vulkan
