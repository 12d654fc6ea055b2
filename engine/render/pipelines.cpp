// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines.h"

namespace gloam {

Pipelines::~Pipelines() {
  for (auto& [name, entry] : entries_) device_.destroy(entry.pipeline);
}

template <class Desc>
Result<gpu::PipelineHandle> Pipelines::find_or_make(const Desc& desc) {
  if (const gpu::PipelineHandle found = find(desc.name)) return found;
  auto made = device_.create_pipeline(desc);  // outside the lock: compiling takes long
  if (!made.ok()) return made.error();
  const std::lock_guard lock(mutex_);
  const auto [place, fresh] = entries_.try_emplace(desc.name, Entry{desc.module, *made});
  if (!fresh) device_.destroy(*made);  // another thread was faster
  return place->second.pipeline;
}

template Result<gpu::PipelineHandle> Pipelines::find_or_make(const gpu::ComputePipelineDesc&);
template Result<gpu::PipelineHandle> Pipelines::find_or_make(const gpu::GraphicsPipelineDesc&);

gpu::PipelineHandle Pipelines::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  return found == entries_.end() ? gpu::PipelineHandle{} : found->second.pipeline;
}

void Pipelines::release(std::string_view module) {
  const std::lock_guard lock(mutex_);
  for (auto it = entries_.begin(); it != entries_.end();) {
    if (it->second.module != module) {
      ++it;
      continue;
    }
    device_.destroy(it->second.pipeline);
    it = entries_.erase(it);
  }
}

}  // namespace gloam
