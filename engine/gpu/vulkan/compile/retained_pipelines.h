// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// Owns one VkPipeline.
class PipelineObject {
 public:
  PipelineObject(Context& context, VkPipeline pipeline) : context_(context), pipeline_(pipeline) {}
  ~PipelineObject() { context_.vk.vkDestroyPipeline(context_.device, pipeline_, context_.allocation); }
  PipelineObject(const PipelineObject&) = delete;
  PipelineObject& operator=(const PipelineObject&) = delete;
  [[nodiscard]] VkPipeline get() const { return pipeline_; }

 private:
  Context& context_;
  VkPipeline pipeline_;
};

/// Keeps the newest `capacity` compiled pipelines by content hash, so that creating an equal pipeline again needs no
/// compilation. Capacity 0 keeps none. Thread-safe.
class RetainedPipelines {
 public:
  explicit RetainedPipelines(std::size_t capacity) : capacity_(capacity) {}
  /// Returns null if no pipeline with this content is kept.
  [[nodiscard]] std::shared_ptr<const PipelineObject> find(std::uint64_t content);
  /// Adds a pipeline and removes the oldest one if the capacity is exceeded. If the content is already kept, the first
  /// pipeline stays.
  void keep(std::uint64_t content, std::shared_ptr<const PipelineObject> pipeline);
  /// False: nothing is kept, so find() always returns null.
  [[nodiscard]] bool enabled() const { return capacity_ > 0; }

 private:
  const std::size_t capacity_;
  std::mutex mutex_;
  std::unordered_map<std::uint64_t, std::shared_ptr<const PipelineObject>> pipelines_;
  std::deque<std::uint64_t> order_;  ///< oldest first
};

}  // namespace gloam::gpu::vulkan
