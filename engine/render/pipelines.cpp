// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines.h"

#include "engine/core/assert.h"
#include "engine/core/hash.h"

namespace gloam {
namespace {

using AnyDesc = PipelineList::value_type;

const std::string& name_of(const AnyDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.name; }, desc);
}
const std::string& module_of(const AnyDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.module; }, desc);
}

/// Hashes the address of the shader's words, not the words: shaders live as long as the device uses them.
void add_shader(Hasher& hash, const gpu::ShaderCode& shader) {
  hash.text(shader.name).value(reinterpret_cast<std::uintptr_t>(shader.words.data())).value(shader.words.size());
}
void add_constants(Hasher& hash, const std::vector<gpu::SpecConstant>& constants) {
  hash.value(constants.size());
  for (const gpu::SpecConstant& constant : constants) hash.value(constant.id).value(constant.value);
}

std::uint64_t hash_of(const gpu::ComputePipelineDesc& desc) {
  Hasher hash;
  hash.text("compute").text(desc.module);
  add_shader(hash, desc.shader);
  add_constants(hash, desc.constants);
  return hash.digest();
}

std::uint64_t hash_of(const gpu::GraphicsPipelineDesc& desc) {
  Hasher hash;
  hash.text("graphics").text(desc.module);
  add_shader(hash, desc.vertex);
  add_shader(hash, desc.fragment);
  add_constants(hash, desc.constants);
  hash.value(desc.attributes.size());
  for (const gpu::VertexAttribute& attribute : desc.attributes)
    hash.value(attribute.location).value(attribute.stream).value(attribute.format).value(attribute.offset);
  hash.value(desc.stream_strides.size());
  for (const std::uint32_t stride : desc.stream_strides) hash.value(stride);
  hash.value(desc.color_formats.size());
  for (const gpu::Format format : desc.color_formats) hash.value(format);
  hash.value(desc.depth_format).value(desc.cull).value(desc.blend).value(desc.depth_compare);
  hash.value(desc.depth_write).value(desc.depth_bias);
  return hash.digest();
}

}  // namespace

Pipelines::~Pipelines() {
  worker_ = std::jthread();  // stops the worker and waits for it
  for (auto& [name, entry] : entries_) device_.destroy(entry.pipeline);
}

template <class Desc>
Result<gpu::PipelineHandle> Pipelines::find_or_make(const Desc& desc) {
  const std::uint64_t description = hash_of(desc);
  const auto checked = [&](const Entry& entry) {
    GLOAM_ASSERT(
        entry.description == description,
        "pipeline " + desc.name +
            " was made from another description: a name must hold every constant, format and state that varies");
    return entry.pipeline;
  };
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = entries_.find(desc.name); found != entries_.end()) return checked(found->second);
  }
  auto made = device_.create_pipeline(desc);  // outside the lock: compiling takes long
  if (!made.ok()) return made.error();
  const std::lock_guard lock(mutex_);
  failed_.erase(desc.name);
  const auto [place, fresh] = entries_.try_emplace(desc.name, Entry{desc.module, *made, description});
  if (!fresh) device_.destroy(*made);  // another thread was faster
  return checked(place->second);
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
    worker_ = std::jthread([this, &log](const std::stop_token& stop) { run_worker(stop, log); });
  wake_.notify_one();
  return ready;
}

std::size_t Pipelines::pending() const {
  const std::lock_guard lock(mutex_);
  return begun_.size();
}

void Pipelines::run_worker(const std::stop_token& stop, LogSink& log) {
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
