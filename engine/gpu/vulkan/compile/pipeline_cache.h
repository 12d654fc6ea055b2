// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "engine/gpu/vulkan/startup/context.h"

namespace gloam::gpu::vulkan {

/// A VkPipelineCache that is kept in one file per device and driver. A warning tells of a damaged file, which is
/// ignored. If the directory cannot be written, only a warning is logged.
class PipelineCache {
 public:
  /// `directory` empty: nothing is read or written.
  PipelineCache(Context& context, const std::string& directory);
  /// Writes the file, completely or not at all.
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Null if the driver could not create a cache; pipelines then compile without one.
  [[nodiscard]] VkPipelineCache handle() const { return cache_; }

 private:
  void save() const;

  Context& context_;
  std::filesystem::path file_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace gloam::gpu::vulkan
