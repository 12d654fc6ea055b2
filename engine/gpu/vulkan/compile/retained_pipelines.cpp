// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/compile/retained_pipelines.h"

#include <utility>

namespace gloam::gpu::vulkan {

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
