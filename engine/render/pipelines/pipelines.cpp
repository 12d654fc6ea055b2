// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines/pipelines.h"

#include <algorithm>
#include <system_error>
#include <type_traits>

#include "engine/core/hash.h"
#include "engine/gpu/pipeline_hash.h"

namespace gloam {
namespace {

using AnyDesc = PipelineList::value_type;

const std::string& module_of(const AnyDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.module; }, desc);
}

template <class Desc>
std::uint64_t hash_of(const Desc& desc) {
  return Hasher().text(desc.module).value(gpu::description_hash(desc, gpu::ShaderIdentity::address)).digest();
}
std::uint64_t key_of_any(const AnyDesc& desc) {
  return std::visit([](const auto& d) { return hash_of(d); }, desc);
}

bool has_shader(const gpu::ComputePipelineDesc& desc, std::string_view name) { return desc.shader.name == name; }
bool has_shader(const gpu::GraphicsPipelineDesc& desc, std::string_view name) {
  return desc.vertex.name == name || desc.fragment.name == name;
}

std::size_t words_of(const AnyDesc& any) {
  return std::visit(
      [](const auto& desc) {
        if constexpr (requires { desc.fragment; })
          return desc.vertex.words.size() + desc.fragment.words.size();
        else
          return desc.shader.words.size();
      },
      any);
}

std::string_view shader_of(const gpu::ComputePipelineDesc& desc) { return desc.shader.name; }
std::string_view shader_of(const gpu::GraphicsPipelineDesc& desc) {
  return desc.fragment.words.empty() ? desc.vertex.name : desc.fragment.name;
}

template <class Desc>
std::string name_of(const Desc& desc) {
  if (!desc.name.empty()) return desc.name;
  std::string name(shader_of(desc));
  const char* separator = " ";
  for (const gpu::SpecConstant& constant : desc.constants) {
    name += separator + std::string(constant.name) + "=" + gpu::text_of(constant.value);
    separator = ",";
  }
  return name;
}

}  // namespace

std::uint64_t Pipelines::key_of(const gpu::ComputePipelineDesc& desc) { return hash_of(desc); }
std::uint64_t Pipelines::key_of(const gpu::GraphicsPipelineDesc& desc) { return hash_of(desc); }

Pipelines::~Pipelines() {
  worker_ = std::jthread();  // stops the worker and waits for it
  for (auto& [name, entry] : entries_) device_.destroy(entry.pipeline);
}

std::optional<gpu::PipelineHandle> Pipelines::find_or_take(std::uint64_t key, bool in_background) {
  const std::lock_guard lock(mutex_);
  if (const auto found = entries_.find(key); found != entries_.end()) {
    found->second.asked_for = found->second.asked_for || !in_background;
    found->second.last_frame = frame_;
    return found->second.pipeline;
  }
  if (std::erase_if(queue_, [&](const AnyDesc& queued) { return key_of_any(queued) == key; }) > 0) begun_.erase(key);
  return std::nullopt;
}

template <class Desc>
Result<gpu::PipelineHandle> Pipelines::find_or_make(const Desc& desc, bool in_background) {
  const std::uint64_t key = key_of(desc);
  if (const auto found = find_or_take(key, in_background)) return *found;
  Desc named = desc;
  named.name = name_of(desc);
  {
    const std::lock_guard lock(mutex_);
    if constexpr (std::is_same_v<Desc, gpu::ComputePipelineDesc>) {
      named.shader = current(desc.shader);
    } else {
      named.vertex = current(desc.vertex);
      named.fragment = current(desc.fragment);
    }
    // The new code of a replaced shader may not use all constants.
    if (!replaced_.empty()) named.constants = desc.constants.where_present();
  }
  auto made = device_.create_pipeline(named);  // outside the lock: compiling takes long
  if (!made.ok()) return made.error();
  const std::lock_guard lock(mutex_);
  failed_.erase(key);
  const auto [place, fresh] = entries_.try_emplace(key, Entry{desc, *made});
  place->second.asked_for = place->second.asked_for || !in_background;
  place->second.last_frame = frame_;
  if (!fresh) device_.destroy(*made);  // another thread was faster
  return place->second.pipeline;
}

template Result<gpu::PipelineHandle> Pipelines::find_or_make(const gpu::ComputePipelineDesc&, bool);
template Result<gpu::PipelineHandle> Pipelines::find_or_make(const gpu::GraphicsPipelineDesc&, bool);

template <class Desc>
gpu::PipelineHandle Pipelines::find_existing(const Desc& desc) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key_of(desc));
  if (found == entries_.end()) return {};
  found->second.asked_for = true;
  found->second.last_frame = frame_;
  return found->second.pipeline;
}
gpu::PipelineHandle Pipelines::find(const gpu::ComputePipelineDesc& desc) const { return find_existing(desc); }
gpu::PipelineHandle Pipelines::find(const gpu::GraphicsPipelineDesc& desc) const { return find_existing(desc); }

bool Pipelines::request(const PipelineList& list, LogSink& log) {
  std::unique_lock lock(mutex_);
  bool ready = true;
  for (const AnyDesc& desc : list) {
    const std::uint64_t key = key_of_any(desc);
    const auto found = entries_.find(key);
    if (found != entries_.end()) found->second.last_frame = frame_;
    if (found != entries_.end() || failed_.contains(key)) continue;
    ready = false;
    if (begun_.insert(key).second) queue_.push_back(desc);
  }
  try {
    if (!ready && !worker_.joinable())
      worker_ = std::jthread([this, &log](const std::stop_token& stop) { run_worker(stop, log); });
  } catch (const std::system_error&) {  // the system gives no thread: this one makes a pipeline a frame
    if (!queue_.empty()) make_first(lock, log);
  }
  wake_.notify_one();
  return ready;
}

std::size_t Pipelines::pending() const {
  const std::lock_guard lock(mutex_);
  return begun_.size();
}

std::string Pipelines::made_in_background() const {
  const std::lock_guard lock(mutex_);
  return made_;
}

void Pipelines::run_worker(const std::stop_token& stop, LogSink& log) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [&] { return !queue_.empty(); }) && !stop.stop_requested()) make_first(lock, log);
}

void Pipelines::make_first(std::unique_lock<std::mutex>& lock, LogSink& log) {
  const AnyDesc desc = std::move(queue_.front());
  queue_.erase(queue_.begin());
  const std::string name = std::visit([](const auto& d) { return name_of(d); }, desc);
  made_ = name;
  lock.unlock();
  const auto made = std::visit([&](const auto& d) { return find_or_make(d, true); }, desc);
  if (!made.ok()) log.warning("pipeline " + name + " failed in the background: " + made.error().message);
  lock.lock();
  begun_.erase(key_of_any(desc));
  if (!made.ok()) failed_.insert_or_assign(key_of_any(desc), module_of(desc));
}

gpu::ShaderCode Pipelines::current(const gpu::ShaderCode& shader) const {
  const auto found = replaced_.find(std::string(shader.name));
  return found == replaced_.end() ? shader : gpu::ShaderCode{shader.name, found->second.back()};
}

void Pipelines::replace_shader(std::string_view name, std::vector<std::uint32_t> words) {
  const std::lock_guard lock(mutex_);
  replaced_[std::string(name)].push_back(std::move(words));
  ++replacements_;
  failed_.clear();  // they may succeed now
  std::erase_if(entries_, [&](const auto& entry) {
    if (!std::visit([&](const auto& desc) { return has_shader(desc, name); }, entry.second.desc)) return false;
    device_.destroy(entry.second.pipeline);
    return true;
  });
}

void Pipelines::begin_frame() {
  const std::lock_guard lock(mutex_);
  ++frame_;
}

void Pipelines::release_unused() {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const auto& entry) {
    if (entry.second.last_frame + kUnusedFrames >= frame_) return false;
    device_.destroy(entry.second.pipeline);
    return true;
  });
}

std::uint64_t Pipelines::replacements() const {
  const std::lock_guard lock(mutex_);
  return replacements_;
}

std::string Pipelines::record() const {
  PipelineList list;
  const std::lock_guard lock(mutex_);
  for (const auto& [key, entry] : entries_)
    if (entry.asked_for) list.push_back(entry.desc);
  return pipeline_record(list);
}

std::size_t Pipelines::request_record(std::string_view record, std::span<const gpu::ShaderCode* const> shaders,
                                      LogSink& log) {
  PipelineList list;
  {
    const std::lock_guard lock(mutex_);
    list = parse_pipeline_record(record, shaders, names_);
  }
  std::ranges::stable_sort(list, {}, words_of);
  static_cast<void>(request(list, log));
  return list.size();
}

void Pipelines::release(std::string_view module) {
  const std::lock_guard lock(mutex_);
  for (const AnyDesc& desc : queue_)
    if (module_of(desc) == module) begun_.erase(key_of_any(desc));
  std::erase_if(queue_, [&](const AnyDesc& desc) { return module_of(desc) == module; });
  std::erase_if(failed_, [&](const auto& failed) { return failed.second == module; });
  for (auto it = entries_.begin(); it != entries_.end();) {
    if (module_of(it->second.desc) != module) {
      ++it;
      continue;
    }
    device_.destroy(it->second.pipeline);
    it = entries_.erase(it);
  }
}

}  // namespace gloam
