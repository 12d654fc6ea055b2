// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"
#include "engine/gpu/device.h"

namespace gloam {

/// Pipelines by name, made on first use. A name stands for one description. Safe from many threads.
class Pipelines {
 public:
  explicit Pipelines(gpu::Device& device) : device_(device) {}
  ~Pipelines();
  Pipelines(const Pipelines&) = delete;
  Pipelines& operator=(const Pipelines&) = delete;

  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::ComputePipelineDesc& desc) { return find_or_make(desc); }
  [[nodiscard]] Result<gpu::PipelineHandle> get(const gpu::GraphicsPipelineDesc& desc) { return find_or_make(desc); }
  /// The pipeline of a name that was made before, or none.
  [[nodiscard]] gpu::PipelineHandle find(std::string_view name) const;
  /// Destroys all pipelines of a module.
  void release(std::string_view module);

 private:
  template <class Desc>
  [[nodiscard]] Result<gpu::PipelineHandle> find_or_make(const Desc& desc);

  struct Entry {
    std::string module;
    gpu::PipelineHandle pipeline;
  };
  gpu::Device& device_;
  mutable std::mutex mutex_;
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace gloam
