// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/gpu/types.h"
#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// Samplers by description. Each is created once and lives as long as the device. Thread-safe.
class Samplers {
 public:
  explicit Samplers(Context& context) : context_(context) {}
  ~Samplers();

  [[nodiscard]] Result<SamplerHandle> find_or_create(const SamplerDesc& desc);
  [[nodiscard]] VkSampler get(SamplerHandle handle) const;

 private:
  Context& context_;
  mutable std::mutex mutex_;
  std::vector<std::pair<SamplerDesc, VkSampler>> samplers_;
};

}  // namespace gloam::gpu::vulkan
