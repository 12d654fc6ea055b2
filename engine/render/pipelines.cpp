// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines.h"

namespace gloam {
namespace {

using AnyDesc = PipelineList::value_type;

const std::string& name_of(const AnyDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.name; }, desc);
}
const std::string& module_of(const AnyDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.module; }, desc);
}

}  // namespace

Pipelines::~Pipelines() {
  worker_ = std::jthread();  // stops it and waits
  for (auto& [name, entry] : entries_) device_.destroy(entry.pipeline);
}

template <class Desc>
Result<gpu::PipelineHandle> Pipelines::find_or_make(const Desc& desc) {
  if (const gpu::PipelineHandle found = find(desc.name)) return found;
  auto made = device_.create_pipeline(desc);  // outside the lock: compiling takes long
  if (!made.ok()) return made.error();
  const std::lock_guard lock(mutex_);
  failed_.erase(desc.name);
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

bool Pipelines::request(const PipelineList& list, LogSink& log) {
  const std::lock_guard lock(mutex_);
  bool ready = true;
  for (const AnyDesc& desc : list) {
    const std::string& name = name_of(desc);
    if (entries_.contains(name) || failed_.contains(name)) continue;
    ready = false;
    if (begun_.insert(name).second) queue_.push_back(desc);
  }
  if (!ready && !worker_.joinable())
    worker_ = std::jthread([this, &log](std::stop_token stop) { run_worker(std::move(stop), log); });
  wake_.notify_one();
  return ready;
}

void Pipelines::run_worker(std::stop_token stop, LogSink& log) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return !queue_.empty(); }) && !stop.stop_requested()) {
    const AnyDesc desc = std::move(queue_.front());
    queue_.erase(queue_.begin());
    lock.unlock();
    const auto made = std::visit([&](const auto& d) { return get(d); }, desc);
    if (!made.ok()) log.warning("pipeline " + name_of(desc) + " failed in the background: " + made.error().message);
    lock.lock();
    begun_.erase(name_of(desc));
    if (!made.ok()) failed_.insert_or_assign(name_of(desc), module_of(desc));
  }
}

void Pipelines::release(std::string_view module) {
  const std::lock_guard lock(mutex_);
  for (const AnyDesc& desc : queue_)
    if (module_of(desc) == module) begun_.erase(name_of(desc));
  std::erase_if(queue_, [&](const AnyDesc& desc) { return module_of(desc) == module; });
  std::erase_if(failed_, [&](const auto& failed) { return failed.second == module; });
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
