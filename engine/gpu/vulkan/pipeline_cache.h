// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "engine/gpu/vulkan/context.h"

namespace gloam::gpu::vulkan {

/// Compiled pipelines, kept in one file a device and driver. A file that is damaged or of another driver counts as
/// absent; a directory that cannot be written costs a warning, never more.
class PipelineCache {
 public:
  /// `directory` empty: nothing is read or written.
  PipelineCache(Context& context, const std::string& directory);
  /// Writes the file, complete or not at all.
  ~PipelineCache();
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  /// Null when the driver could not make one; pipelines compile without.
  [[nodiscard]] VkPipelineCache handle() const { return cache_; }

 private:
  void save() const;

  Context& context_;
  std::filesystem::path file_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace gloam::gpu::vulkan
