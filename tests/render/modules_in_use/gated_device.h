// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "engine/gpu/device.h"

namespace gloam::test {

/// Wraps a device with a gate. Pipelines that threads other than its creator's request wait until the gate lets them
/// through. It counts created resources and can make named pipelines fail. Thread-safe.
class GatedDevice : public gpu::Device {
 public:
  explicit GatedDevice(gpu::Device& inner) : inner_(inner) {}

  /// After this call, pipelines of other threads wait at the gate.
  void close() { set_permits(0); }
  /// Lets the next `count` pipelines through.
  void let(std::uint32_t count) { set_permits(count); }
  void open() { set_permits(kOpen); }
  /// Waits until a pipeline waits at the gate and no other one may pass. False if that takes more than 20 s.
  [[nodiscard]] bool wait_for_one_at_the_gate() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(20), [&] { return waiting_ > 0 && permits_ == 0; });
  }
  /// Makes the creation of this pipeline fail until heal().
  void break_pipeline(std::string name, Error error) {
    const std::lock_guard lock(mutex_);
    broken_.insert_or_assign(std::move(name), std::move(error));
  }
  /// Makes the next submit_frame fail with this error, after dropping the frame's commands.
  void break_submission(Error error) { broken_submission_ = std::move(error); }
  void heal() {
    const std::lock_guard lock(mutex_);
    broken_.clear();
  }

  /// Pipelines of a module that the thread which created this device has requested.
  [[nodiscard]] std::uint32_t asked_here(std::string_view module) const { return asked(here_, module); }
  /// Pipelines of a module that other threads have requested.
  [[nodiscard]] std::uint32_t asked_elsewhere(std::string_view module) const { return asked(elsewhere_, module); }
  /// Number of buffers and images created so far.
  [[nodiscard]] std::uint64_t resources_made() const {
    const std::lock_guard lock(mutex_);
    return resources_made_;
  }

  [[nodiscard]] const gpu::DeviceInfo& info() const override { return inner_.info(); }
  [[nodiscard]] bool supports(gpu::Format format, gpu::ImageUsage usage) const override {
    return inner_.supports(format, usage);
  }
  [[nodiscard]] bool supports_blit(gpu::Format format) const override { return inner_.supports_blit(format); }
  [[nodiscard]] Result<gpu::BufferHandle> create_buffer(const gpu::BufferDesc& desc) override {
    count_resource();
    return inner_.create_buffer(desc);
  }
  [[nodiscard]] Result<gpu::ImageHandle> create_image(const gpu::ImageDesc& desc) override {
    count_resource();
    return inner_.create_image(desc);
  }
  [[nodiscard]] Result<std::vector<gpu::ImageHandle>> create_aliased_images(
      std::span<const gpu::ImageDesc> descs) override {
    count_resource();
    return inner_.create_aliased_images(descs);
  }
  [[nodiscard]] Result<gpu::MemoryNeeds> memory_needs(const gpu::ImageDesc& desc) const override {
    return inner_.memory_needs(desc);
  }
  [[nodiscard]] Result<gpu::MemoryNeeds> memory_needs(const gpu::BufferDesc& desc) const override {
    return inner_.memory_needs(desc);
  }
  [[nodiscard]] Result<gpu::MemoryHandle> create_memory(const gpu::MemoryDesc& desc) override {
    return inner_.create_memory(desc);
  }
  [[nodiscard]] Result<gpu::ImageHandle> create_image(const gpu::ImageDesc& desc,
                                                      const gpu::MemoryPlace& place) override {
    count_resource();
    return inner_.create_image(desc, place);
  }
  [[nodiscard]] Result<gpu::BufferHandle> create_buffer(const gpu::BufferDesc& desc,
                                                        const gpu::MemoryPlace& place) override {
    count_resource();
    return inner_.create_buffer(desc, place);
  }
  void destroy(gpu::MemoryHandle memory) override { inner_.destroy(memory); }
  void account(gpu::MemoryHandle memory, std::span<const gpu::ModuleMemory> shares) override {
    inner_.account(memory, shares);
  }
  [[nodiscard]] Result<gpu::SamplerHandle> create_sampler(const gpu::SamplerDesc& desc) override {
    return inner_.create_sampler(desc);
  }
  [[nodiscard]] Result<gpu::PipelineHandle> create_pipeline(const gpu::ComputePipelineDesc& desc) override {
    return make(desc);
  }
  [[nodiscard]] Result<gpu::PipelineHandle> create_pipeline(const gpu::GraphicsPipelineDesc& desc) override {
    return make(desc);
  }
  [[nodiscard]] Result<gpu::ResourceSetHandle> create_resource_set(gpu::PipelineHandle like, std::uint32_t set,
                                                                   std::span<const gpu::Binding> bindings) override {
    return inner_.create_resource_set(like, set, bindings);
  }
  void destroy(gpu::BufferHandle buffer) override { inner_.destroy(buffer); }
  void destroy(gpu::ImageHandle image) override { inner_.destroy(image); }
  void destroy(gpu::PipelineHandle pipeline) override { inner_.destroy(pipeline); }
  void destroy(gpu::ResourceSetHandle resources) override { inner_.destroy(resources); }
  [[nodiscard]] const gpu::BufferDesc& desc(gpu::BufferHandle buffer) const override { return inner_.desc(buffer); }
  [[nodiscard]] const gpu::ImageDesc& desc(gpu::ImageHandle image) const override { return inner_.desc(image); }
  [[nodiscard]] std::span<std::byte> mapped(gpu::BufferHandle buffer) override { return inner_.mapped(buffer); }
  [[nodiscard]] Result<gpu::CommandList*> begin_frame() override { return inner_.begin_frame(); }
  [[nodiscard]] Status submit_frame() override {
    if (!broken_submission_) return inner_.submit_frame();
    GLOAM_TRY(inner_.abandon_frame());
    return *std::exchange(broken_submission_, std::nullopt);
  }
  [[nodiscard]] Status abandon_frame() override { return inner_.abandon_frame(); }
  [[nodiscard]] Status wait_frame(std::uint64_t frame) override { return inner_.wait_frame(frame); }
  [[nodiscard]] std::uint64_t frame_number() const override { return inner_.frame_number(); }
  [[nodiscard]] std::uint64_t completed_frames() const override { return inner_.completed_frames(); }
  [[nodiscard]] std::vector<std::uint64_t> timestamps(std::uint64_t frame) override { return inner_.timestamps(frame); }
  [[nodiscard]] Status wait_idle() override { return inner_.wait_idle(); }
  [[nodiscard]] std::vector<gpu::ModuleMemory> memory() const override { return inner_.memory(); }
  [[nodiscard]] gpu::MemoryTotals memory_totals() const override { return inner_.memory_totals(); }
  void free_idle_memory() override { inner_.free_idle_memory(); }
  [[nodiscard]] std::uint32_t pipeline_count(std::string_view module) const override {
    return inner_.pipeline_count(module);
  }
  [[nodiscard]] std::uint64_t validation_messages() const override { return inner_.validation_messages(); }

 private:
  static constexpr std::uint32_t kOpen = std::numeric_limits<std::uint32_t>::max();
  using Counts = std::map<std::string, std::uint32_t, std::less<>>;

  void set_permits(std::uint32_t count) {
    const std::lock_guard lock(mutex_);
    permits_ = count;
    changed_.notify_all();
  }
  void count_resource() {
    const std::lock_guard lock(mutex_);
    ++resources_made_;
  }
  [[nodiscard]] std::uint32_t asked(const Counts& counts, std::string_view module) const {
    const std::lock_guard lock(mutex_);
    const auto found = counts.find(module);
    return found == counts.end() ? 0 : found->second;
  }

  template <class Desc>
  [[nodiscard]] Result<gpu::PipelineHandle> make(const Desc& desc) {
    {
      std::unique_lock lock(mutex_);
      const bool here = std::this_thread::get_id() == maker_;
      ++(here ? here_ : elsewhere_)[desc.module];
      if (!here) {
        ++waiting_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return permits_ > 0; });
        --waiting_;
        if (permits_ != kOpen) --permits_;
      }
      if (const auto broken = broken_.find(desc.name); broken != broken_.end()) return broken->second;
    }
    return inner_.create_pipeline(desc);
  }

  gpu::Device& inner_;
  const std::thread::id maker_ = std::this_thread::get_id();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t permits_ = kOpen;
  std::uint32_t waiting_ = 0;
  std::map<std::string, Error, std::less<>> broken_;
  std::optional<Error> broken_submission_;
  Counts here_;
  Counts elsewhere_;
  std::uint64_t resources_made_ = 0;
};

}  // namespace gloam::test
