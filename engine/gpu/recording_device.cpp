// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/recording_device.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/gpu/image_size.h"
#include "engine/gpu/recording/command_recorder.h"
#include "engine/gpu/recording/objects.h"

namespace gloam::gpu {

namespace {

using namespace recording;

constexpr std::size_t kFramesOfTimestampsKept = 4;

class Recorder final : public RecordingDevice {
 public:
  Recorder() : commands_(objects_) {
    info_ = {.name = "recording device",
             .driver = "none",
             .type = DeviceType::other,
             .subgroup_size = 8,
             .max_storage_range = std::uint64_t{128} << 20};
  }

  const DeviceInfo& info() const override { return info_; }

  Result<BufferHandle> create_buffer(const BufferDesc& desc) override {
    GLOAM_TRY(creation_status());
    GLOAM_ASSERT(desc.size > 0, "a buffer has at least one byte");
    return BufferHandle{objects_.buffers.add(Buffer{.desc = desc}), 1};
  }

  Result<ImageHandle> create_image(const ImageDesc& desc) override {
    GLOAM_TRY(creation_status());
    auto memory = std::make_shared<ImageMemory>();
    memory->module = desc.module;
    return add_image(desc, std::move(memory));
  }

  Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) override {
    GLOAM_TRY(creation_status());
    std::vector<ImageHandle> images;
    auto memory = std::make_shared<ImageMemory>();
    if (!descs.empty()) memory->module = descs.front().module;
    for (const ImageDesc& desc : descs) images.push_back(add_image(desc, memory));
    return images;
  }

  Result<SamplerHandle> create_sampler(const SamplerDesc& desc) override {
    GLOAM_TRY(creation_status());
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(samplers_, desc);
    const auto index = static_cast<std::uint32_t>(found - samplers_.begin());
    if (found == samplers_.end()) samplers_.push_back(desc);
    return SamplerHandle{index, 1};
  }

  Result<PipelineHandle> create_pipeline(const ComputePipelineDesc& desc) override {
    return add_pipeline({.name = desc.name, .module = desc.module, .compute = true});
  }
  Result<PipelineHandle> create_pipeline(const GraphicsPipelineDesc& desc) override {
    return add_pipeline({.name = desc.name,
                         .module = desc.module,
                         .compute = false,
                         .vertex_streams = static_cast<std::uint32_t>(desc.stream_strides.size())});
  }

  Result<ResourceSetHandle> create_resource_set(PipelineHandle like, std::uint32_t set,
                                                std::span<const Binding> bindings) override {
    GLOAM_TRY(creation_status());
    GLOAM_ASSERT(set >= 1, "set 0 is bound with CommandList::bind; resource sets have numbers from 1");
    if (objects_.pipelines.find(like) == nullptr) objects_.fault("create_resource_set: a pipeline that is not alive");
    check_bindings(objects_, bindings, "create_resource_set");
    return ResourceSetHandle{
        objects_.resource_sets.add(ResourceSet{.set = set, .bindings = {bindings.begin(), bindings.end()}}), 1};
  }

  void destroy(BufferHandle handle) override {
    Buffer* buffer = objects_.buffers.find(handle);
    if (buffer == nullptr) return objects_.fault("destroy: a buffer that is not alive");
    buffer->alive = false;
    buffer->bytes = {};
  }
  void destroy(ImageHandle handle) override {
    Image* image = objects_.images.find(handle);
    if (image == nullptr) return objects_.fault("destroy: an image that is not alive");
    image->alive = false;
    image->texels.clear();
  }
  void destroy(PipelineHandle handle) override {
    Pipeline* pipeline = objects_.pipelines.find(handle);
    if (pipeline == nullptr) return objects_.fault("destroy: a pipeline that is not alive");
    pipeline->alive = false;
  }
  void destroy(ResourceSetHandle handle) override {
    ResourceSet* set = objects_.resource_sets.find(handle);
    if (set == nullptr) return objects_.fault("destroy: a resource set that is not alive");
    set->alive = false;
  }

  const BufferDesc& desc(BufferHandle handle) const override {
    const Buffer* buffer = objects_.buffers.find(handle);
    GLOAM_ASSERT(buffer != nullptr, "this buffer is not alive");
    return buffer->desc;
  }
  const ImageDesc& desc(ImageHandle handle) const override {
    const Image* image = objects_.images.find(handle);
    GLOAM_ASSERT(image != nullptr, "this image is not alive");
    return image->desc;
  }
  std::span<std::byte> mapped(BufferHandle handle) override {
    Buffer* buffer = objects_.buffers.find(handle);
    GLOAM_ASSERT(buffer != nullptr, "this buffer is not alive");
    GLOAM_ASSERT(buffer->desc.memory != MemoryKind::device, "device memory is not mapped");
    return bytes_of(*buffer);
  }

  Result<CommandList*> begin_frame() override {
    GLOAM_ASSERT(!commands_.recording(), "begin_frame needs the frame before it to be submitted");
    commands_.begin_frame(frame_);
    return static_cast<CommandList*>(&commands_);
  }
  Status submit_frame() override {
    GLOAM_ASSERT(commands_.recording(), "submit_frame needs begin_frame before it");
    timestamps_[frame_] = commands_.end_frame();
    if (timestamps_.size() > kFramesOfTimestampsKept) timestamps_.erase(timestamps_.begin());
    ++frame_;
    return {};
  }
  Status abandon_frame() override {
    GLOAM_ASSERT(commands_.recording(), "abandon_frame needs begin_frame before it");
    commands_.abandon_frame();
    ++frame_;
    return {};
  }
  Status wait_frame(std::uint64_t frame) override {
    GLOAM_ASSERT(frame < frame_, "a frame is submitted before it is waited for");
    return {};
  }
  std::uint64_t frame_number() const override { return frame_; }
  std::uint64_t completed_frames() const override { return frame_; }
  std::vector<std::uint64_t> timestamps(std::uint64_t frame) override {
    const auto found = timestamps_.find(frame);
    return found == timestamps_.end() ? std::vector<std::uint64_t>{} : found->second;
  }
  Status wait_idle() override {
    commands_.idle();
    return {};
  }

  std::vector<ModuleMemory> memory() const override {
    std::map<std::string, std::uint64_t> bytes;
    objects_.buffers.for_each_alive([&](const Buffer& buffer) { bytes[buffer.desc.module] += buffer.desc.size; });
    std::vector<const ImageMemory*> counted;
    objects_.images.for_each_alive([&](const Image& image) {
      if (std::ranges::find(counted, image.memory.get()) != counted.end()) return;
      counted.push_back(image.memory.get());
      bytes[image.memory->module] += image.memory->bytes;
    });
    std::vector<ModuleMemory> result;
    for (const auto& [module, count] : bytes) result.push_back({module, count});
    return result;
  }
  std::uint32_t pipeline_count(std::string_view module) const override {
    std::uint32_t count = 0;
    objects_.pipelines.for_each_alive([&](const Pipeline& pipeline) { count += pipeline.module == module ? 1 : 0; });
    return count;
  }
  std::uint64_t validation_messages() const override { return objects_.faults.size(); }

  const std::vector<RecordedCommand>& commands() const override { return commands_.commands(); }
  const std::vector<std::string>& faults() const override { return objects_.faults; }
  void forget_commands() override { commands_.forget_commands(); }
  void fail_next_creation(Error error) override {
    const std::lock_guard lock(mutex_);
    next_failure_ = std::move(error);
  }

 private:
  Status creation_status() {
    const std::lock_guard lock(mutex_);
    if (auto failure = std::exchange(next_failure_, std::nullopt)) return *std::move(failure);
    return {};
  }

  ImageHandle add_image(const ImageDesc& desc, std::shared_ptr<ImageMemory> memory) {
    GLOAM_ASSERT(desc.format != Format::undefined, "an image has a format");
    GLOAM_ASSERT(desc.width > 0 && desc.height > 0 && desc.layers > 0 && desc.mips > 0,
                 "an image has a width, a height, a layer and a mip");
    memory->bytes = std::max(memory->bytes, image_bytes(desc));
    return ImageHandle{objects_.images.add(Image{.desc = desc, .memory = std::move(memory)}), 1};
  }

  Result<PipelineHandle> add_pipeline(Pipeline pipeline) {
    GLOAM_TRY(creation_status());
    return PipelineHandle{objects_.pipelines.add(std::move(pipeline)), 1};
  }

  DeviceInfo info_;
  Objects objects_;
  CommandRecorder commands_;
  std::uint64_t frame_ = 0;
  std::map<std::uint64_t, std::vector<std::uint64_t>> timestamps_;
  mutable std::mutex mutex_;  ///< guards samplers_ and next_failure_
  std::vector<SamplerDesc> samplers_;
  std::optional<Error> next_failure_;
};

}  // namespace

std::unique_ptr<RecordingDevice> make_recording_device() { return std::make_unique<Recorder>(); }

}  // namespace gloam::gpu
