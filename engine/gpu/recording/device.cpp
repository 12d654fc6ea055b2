// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/recording/device.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "engine/gpu/image_size.h"
#include "engine/gpu/recording/command_recorder.h"
#include "engine/gpu/recording/objects.h"

namespace gloam::gpu {

namespace {

using namespace recording;

constexpr std::size_t kFramesOfTimestampsKept = 4;
/// Depth images need another type of memory than everything else, as on some GPUs.
constexpr std::uint32_t kOtherMemory = 1;
constexpr std::uint32_t kDepthMemory = 2;

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

  bool supports(Format format, ImageUsage usage) const override {
    const std::lock_guard lock(mutex_);
    const auto withdrawn = withdrawn_.find(format);
    if (withdrawn != withdrawn_.end() && has(withdrawn->second, usage)) return false;
    using enum ImageUsage;
    if (format == Format::undefined || format == Format::rgb32_float) return false;
    if (has(usage, is_depth(format) ? storage | color_target : depth_target)) return false;
    return !has(usage, storage) || !encodes_srgb(format);
  }
  bool supports_blit(Format format) const override {
    using enum ImageUsage;
    if (is_depth(format) || is_integer(format) || !supports(format, transfer_source | transfer_target)) return false;
    const std::lock_guard lock(mutex_);
    return std::ranges::find(without_blit_, format) == without_blit_.end();
  }

  Result<BufferHandle> create_buffer(const BufferDesc& desc) override {
    GLOAM_TRY(creation_status());
    GLOAM_ASSERT(desc.size > 0, "a buffer has at least one byte");
    ++allocations_;
    auto memory = std::make_shared<Memory>(Memory{.module = desc.module, .bytes = desc.size});
    auto place = add_placement(*memory, {.bytes = desc.size});
    return BufferHandle{
        objects_.buffers.add(Buffer{.desc = desc, .memory = std::move(memory), .place = std::move(place)}), 1};
  }

  Result<ImageHandle> create_image(const ImageDesc& desc) override {
    GLOAM_TRY(creation_status());
    GLOAM_TRY(support_of(desc));
    ++allocations_;
    auto memory = std::make_shared<Memory>(Memory{.module = desc.module, .bytes = image_bytes(desc)});
    return add_image(desc, std::move(memory), 0);
  }

  Result<std::vector<ImageHandle>> create_aliased_images(std::span<const ImageDesc> descs) override {
    GLOAM_TRY(creation_status());
    for (const ImageDesc& desc : descs) GLOAM_TRY(support_of(desc));
    std::vector<ImageHandle> images;
    auto memory = std::make_shared<Memory>();
    ++allocations_;
    if (!descs.empty()) memory->module = descs.front().module;
    for (const ImageDesc& desc : descs) {
      memory->bytes = std::max(memory->bytes, image_bytes(desc));
      images.push_back(add_image(desc, memory, 0));
    }
    return images;
  }

  Result<MemoryNeeds> memory_needs(const ImageDesc& desc) const override {
    GLOAM_TRY(support_of(desc));
    return MemoryNeeds{.size = image_bytes(desc), .types = is_depth(desc.format) ? kDepthMemory : kOtherMemory};
  }
  Result<MemoryNeeds> memory_needs(const BufferDesc& desc) const override {
    return MemoryNeeds{.size = desc.size, .types = kOtherMemory};
  }
  Result<MemoryHandle> create_memory(const MemoryDesc& desc) override {
    GLOAM_TRY(creation_status());
    GLOAM_ASSERT(desc.size > 0, "a memory block holds at least one byte");
    ++allocations_;
    return MemoryHandle{objects_.blocks.add(Block{.desc = desc, .memory = std::make_shared<Memory>()}), 1};
  }
  Result<ImageHandle> create_image(const ImageDesc& desc, const MemoryPlace& place) override {
    GLOAM_TRY(creation_status());
    const Result<MemoryNeeds> needs = memory_needs(desc);
    if (!needs) return needs.error();
    return add_image(desc, block_at(place, *needs, desc.name), place.offset);
  }
  Result<BufferHandle> create_buffer(const BufferDesc& desc, const MemoryPlace& place) override {
    GLOAM_TRY(creation_status());
    auto memory = block_at(place, memory_needs(desc).value(), desc.name);
    auto bytes = add_placement(*memory, {.offset = place.offset, .bytes = desc.size});
    return BufferHandle{
        objects_.buffers.add(Buffer{.desc = desc, .memory = std::move(memory), .place = std::move(bytes)}), 1};
  }
  void destroy(MemoryHandle handle) override {
    Block* block = objects_.blocks.find(handle);
    if (block == nullptr) return objects_.fault("destroy: a memory block that is not alive");
    block->alive = false;
  }
  void account(MemoryHandle handle, std::span<const ModuleMemory> shares) override {
    Block* block = objects_.blocks.find(handle);
    if (block == nullptr) return objects_.fault("account: a memory block that is not alive");
    block->shares.assign(shares.begin(), shares.end());
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
    GLOAM_ASSERT(buffer != nullptr, "this buffer is not alive: it was destroyed, or is of another device");
    return buffer->desc;
  }
  const ImageDesc& desc(ImageHandle handle) const override {
    const Image* image = objects_.images.find(handle);
    GLOAM_ASSERT(image != nullptr, "this image is not alive: it was destroyed, or is of another device");
    return image->desc;
  }
  std::span<std::byte> mapped(BufferHandle handle) override {
    Buffer* buffer = objects_.buffers.find(handle);
    GLOAM_ASSERT(buffer != nullptr, "this buffer is not alive: it was destroyed, or is of another device");
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
    std::set<const Memory*> counted;
    const auto count_memory = [&](const auto& resource) {
      if (counted.insert(resource.memory.get()).second) bytes[resource.memory->module] += resource.memory->bytes;
    };
    objects_.buffers.for_each_alive(count_memory);
    objects_.images.for_each_alive(count_memory);
    objects_.blocks.for_each_alive([&](const Block& block) {
      std::uint64_t unaccounted = block.desc.size;
      for (const ModuleMemory& share : block.shares) {
        bytes[share.module] += share.bytes;
        unaccounted -= share.bytes;
      }
      bytes[block.desc.module] += unaccounted;
    });
    std::vector<ModuleMemory> result;
    for (const auto& [module, count] : bytes) {
      if (count > 0) result.push_back({module, count});
    }
    return result;
  }
  MemoryTotals memory_totals() const override {
    MemoryTotals totals;
    for (const ModuleMemory& share : memory()) totals.used += share.bytes;
    totals.reserved = totals.used;
    return totals;
  }
  std::uint32_t pipeline_count(std::string_view module) const override {
    std::uint32_t count = 0;
    objects_.pipelines.for_each_alive([&](const Pipeline& pipeline) { count += pipeline.module == module ? 1 : 0; });
    return count;
  }
  std::uint64_t validation_messages() const override { return objects_.faults.size(); }

  const std::vector<RecordedCommand>& commands() const override { return commands_.commands(); }
  std::uint64_t allocations() const override { return allocations_; }
  const std::vector<std::string>& faults() const override { return objects_.faults; }
  void forget_commands() override { commands_.forget_commands(); }
  void fail_next_creation(Error error) override {
    const std::lock_guard lock(mutex_);
    next_failure_ = std::move(error);
  }
  void withdraw_support(Format format, ImageUsage usage, bool blit) override {
    const std::lock_guard lock(mutex_);
    ImageUsage& withdrawn = withdrawn_[format];
    withdrawn = withdrawn | usage;
    if (blit) without_blit_.push_back(format);
  }

 private:
  Status creation_status() {
    const std::lock_guard lock(mutex_);
    if (auto failure = std::exchange(next_failure_, std::nullopt)) return *std::move(failure);
    return {};
  }

  [[nodiscard]] std::shared_ptr<Memory> block_at(const MemoryPlace& place, const MemoryNeeds& needs,
                                                 const std::string& name) {
    const Block* block = objects_.blocks.find(place.memory);
    GLOAM_ASSERT(block != nullptr, "an object is placed in a memory block that is alive");
    GLOAM_ASSERT(place.offset <= block->desc.size && needs.size <= block->desc.size - place.offset,
                 "'" + name + "' lies inside its memory block");
    if ((needs.types & block->desc.types) != block->desc.types) {
      objects_.fault("'" + name + "' is placed in memory of another type");
    }
    return block->memory;
  }

  [[nodiscard]] Status support_of(const ImageDesc& desc) const {
    if (desc.format == Format::undefined || supports(desc.format, desc.usage)) return {};
    return Error{ErrorKind::failed, "Image \"" + desc.name + "\" of module \"" + desc.module +
                                        "\" could not be made: the device cannot use " +
                                        std::string(name_of(desc.format)) + " in that way (" + text_of(desc.usage) +
                                        ")"};
  }

  static std::shared_ptr<Placement> add_placement(Memory& memory, Placement placement) {
    // Only the memory knows of objects that were destroyed; those without accesses in the last frames are forgotten.
    std::erase_if(memory.placements, [](const std::shared_ptr<Placement>& place) {
      bool pending = false;
      place->sync.visit(place->sync.all(), [&](const SyncState& sync) { pending = pending || sync.pending != 0; });
      return place.use_count() == 1 && !pending;
    });
    memory.placements.push_back(std::make_shared<Placement>(std::move(placement)));
    return memory.placements.back();
  }

  ImageHandle add_image(const ImageDesc& desc, std::shared_ptr<Memory> memory, std::uint64_t offset) {
    GLOAM_ASSERT(desc.format != Format::undefined, "an image has a format");
    GLOAM_ASSERT(desc.shape == ImageShape::volume ? desc.layers == 1 : desc.depth == 1,
                 "a volume has a depth and one layer, all other images have no depth");
    GLOAM_ASSERT(desc.width > 0 && desc.height > 0 && desc.depth > 0 && desc.layers > 0 && desc.mips > 0,
                 "an image has a width, a height, a layer and a mip");
    auto place = add_placement(
        *memory,
        {.offset = offset, .bytes = image_bytes(desc), .sync = Subresources<SyncState>(desc.mips, desc.layers)});
    return ImageHandle{objects_.images.add(Image{.desc = desc, .memory = std::move(memory), .place = std::move(place)}),
                       1};
  }

  Result<PipelineHandle> add_pipeline(Pipeline pipeline) {
    GLOAM_TRY(creation_status());
    return PipelineHandle{objects_.pipelines.add(std::move(pipeline)), 1};
  }

  DeviceInfo info_;
  Objects objects_;
  CommandRecorder commands_;
  std::atomic<std::uint64_t> allocations_ = 0;
  std::uint64_t frame_ = 0;
  std::map<std::uint64_t, std::vector<std::uint64_t>> timestamps_;
  mutable std::mutex mutex_;  ///< guards all below
  std::vector<SamplerDesc> samplers_;
  std::optional<Error> next_failure_;
  std::map<Format, ImageUsage> withdrawn_;
  std::vector<Format> without_blit_;
};

}  // namespace

std::unique_ptr<RecordingDevice> make_recording_device() { return std::make_unique<Recorder>(); }

}  // namespace gloam::gpu
