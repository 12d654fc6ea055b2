// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/retained_pipelines.h"

#include <span>
#include <utility>

#include "engine/core/hash.h"

namespace gloam::gpu::vulkan {
namespace {

void add(Hasher& hash, const ShaderCode& code) {
  hash.value(code.words.size()).bytes(std::as_bytes(std::span(code.words)));
}

void add(Hasher& hash, std::span<const SpecConstant> constants) {
  hash.value(constants.size());
  for (const SpecConstant& constant : constants) hash.value(constant.id).value(constant.value);
}

}  // namespace

std::uint64_t content_hash(const ComputePipelineDesc& desc) {
  Hasher hash;
  hash.value(1);  // a compute pipeline
  add(hash, desc.shader);
  add(hash, desc.constants);
  return hash.digest();
}

std::uint64_t content_hash(const GraphicsPipelineDesc& desc) {
  Hasher hash;
  hash.value(2);  // a graphics pipeline
  add(hash, desc.vertex);
  add(hash, desc.fragment);
  add(hash, desc.constants);
  hash.value(desc.attributes.size());
  for (const VertexAttribute& attribute : desc.attributes)
    hash.value(attribute.location).value(attribute.stream).value(attribute.format).value(attribute.offset);
  hash.value(desc.stream_strides.size());
  for (const std::uint32_t stride : desc.stream_strides) hash.value(stride);
  hash.value(desc.color_formats.size());
  for (const Format format : desc.color_formats) hash.value(format);
  hash.value(desc.depth_format).value(desc.cull).value(desc.blend).value(desc.depth_compare);
  hash.value(desc.depth_write).value(desc.depth_bias);
  return hash.digest();
}

std::shared_ptr<const PipelineObject> RetainedPipelines::find(std::uint64_t content) {
  const std::scoped_lock lock(mutex_);
  const auto found = pipelines_.find(content);
  return found == pipelines_.end() ? nullptr : found->second;
}

void RetainedPipelines::keep(std::uint64_t content, std::shared_ptr<const PipelineObject> pipeline) {
  if (!enabled()) return;
  const std::scoped_lock lock(mutex_);
  if (!pipelines_.emplace(content, std::move(pipeline)).second) return;
  order_.push_back(content);
  if (order_.size() <= capacity_) return;
  pipelines_.erase(order_.front());
  order_.pop_front();
}

}  // namespace gloam::gpu::vulkan
