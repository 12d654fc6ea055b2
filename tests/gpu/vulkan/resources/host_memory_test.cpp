// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Memory on a host's terms: its callbacks, its allocator, block sizes, a budget, and what is given back.
#include <gmock/gmock.h>

#include <map>
#include <vector>

#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/counted_memory.h"
#include "tests/support/expect_assert.h"
#include "tests/support/lent_device.h"

namespace gloam::gpu {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

class HostMemoryTest : public VulkanTest {
 protected:
  [[nodiscard]] HostDevice lend() { return test::lend(device(), features_); }
  [[nodiscard]] vulkan::Context& context() { return dynamic_cast<vulkan::VulkanDevice&>(device()).context(); }

  static Result<BufferHandle> make(Device& on, std::uint64_t bytes, MemoryKind kind = MemoryKind::device) {
    return on.create_buffer(
        {.name = "bytes",
         .module = "test",
         .size = bytes,
         .usage = BufferUsage::storage | BufferUsage::transfer_target | BufferUsage::transfer_source,
         .memory = kind});
  }

  /// Uses objects of every kind once: buffers, an image, aliased images, a block, a sampler, a pipeline with and
  /// without sets of its own, and a frame.
  static void use_everything(Device& on) {
    const ImageDesc image_desc = {.name = "image",
                                  .module = "test",
                                  .format = Format::rgba8_unorm,
                                  .width = 16,
                                  .height = 16,
                                  .usage = ImageUsage::transfer_target | ImageUsage::sampled};
    const ImageHandle image = test::value_of(on.create_image(image_desc));
    const std::vector<ImageHandle> aliased =
        test::value_of(on.create_aliased_images(std::vector<ImageDesc>{image_desc, image_desc}));
    const MemoryNeeds needs = test::value_of(on.memory_needs(image_desc));
    const MemoryHandle block = test::value_of(
        on.create_memory({.name = "block", .module = "test", .size = 2 * needs.size, .types = needs.types}));
    const ImageHandle placed = test::value_of(on.create_image(image_desc, MemoryPlace{block, 0}));
    static_cast<void>(test::value_of(on.create_sampler({})));
    const PipelineHandle pipeline = test::value_of(on.create_pipeline(
        ComputePipelineDesc{.name = "double", .module = "test", .shader = shaders::gpu_test::double_numbers_comp}));
    const BufferHandle buffer = test::make_readback(on, 256);
    test::run_frame(on, [&](CommandList& commands) {
      for (const ImageHandle target : {image, aliased[0], placed}) {
        to(commands, target, Access::none, Access::transfer_write);
        commands.clear_color_image(target, {1u, 0u, 0u, 0u});
        to(commands, target, Access::transfer_write, Access::compute_read);
      }
      commands.fill_buffer(buffer, 0, 256, 0xCDu);
      to(commands, buffer, Access::transfer_write, Access::host_read);
    });
    EXPECT_EQ(test::items_of<std::uint32_t>(on, buffer).at(63), 0xCDu);
    for (const ImageHandle made : {image, aliased[0], aliased[1], placed}) on.destroy(made);
    on.destroy(block);
    on.destroy(pipeline);
    on.destroy(buffer);
  }

  vulkan::Features features_;
};

TEST_F(HostMemoryTest, every_object_is_created_and_destroyed_with_the_hosts_callbacks) {
  const test::CountingCallbacks callbacks;
  test::CallWatch watch;
  HostDevice host = lend();
  host.get_instance_proc_addr = test::CallWatch::loader();
  {
    // Read by create_vulkan_device_on only.
    const VkAllocationCallbacks given = *callbacks.get();
    host.allocation_callbacks = &given;
    const auto ours = test::value_of(create_vulkan_device_on(host));
    use_everything(*ours);
    EXPECT_GT(callbacks.live_bytes(), 0);
    EXPECT_GT(watch.live_bytes(), 0u);
  }
  EXPECT_THAT(watch.without_callbacks(), ::testing::IsEmpty());
  EXPECT_THAT(watch.unknown(), ::testing::IsEmpty()) << "these take callbacks too: add them to the watch";
  EXPECT_GE(watch.called().size(), 20u);
  EXPECT_EQ(callbacks.live_bytes(), 0);
  EXPECT_EQ(watch.live_bytes(), 0u);
}

/// A host's allocator in its simplest form: one vkAllocateMemory for each object.
class SimpleAllocator final : public HostMemoryAllocator {
 public:
  explicit SimpleAllocator(vulkan::Context& context) : context_(context) {}

  VkResult allocate(const HostMemoryRequest& request, HostMemory& memory) override {
    ++requests;
    most_name = std::string(request.module) + "." + std::string(request.name);
    if (refuses) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    std::uint32_t type = 0;
    const VkPhysicalDeviceMemoryProperties& properties = context_.physical.memory;
    while (type < properties.memoryTypeCount &&
           ((request.requirements.memoryTypeBits & (1u << type)) == 0 ||
            (properties.memoryTypes[type].propertyFlags & request.required) != request.required))
      ++type;
    // Begins behind a gap, so that offsets of zero are not taken for granted.
    memory.offset = std::max<VkDeviceSize>(request.requirements.alignment, 256);
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = memory.offset + request.requirements.size,
                                       .memoryTypeIndex = type};
    const VkResult result = context_.vk.vkAllocateMemory(context_.device, &info, nullptr, &memory.memory);
    if (result != VK_SUCCESS) return result;
    if (request.mapped) {
      void* begin = nullptr;
      context_.vk.vkMapMemory(context_.device, memory.memory, 0, VK_WHOLE_SIZE, 0, &begin);
      memory.mapped = static_cast<std::byte*>(begin) + memory.offset;
    }
    live[memory.memory] = request.requirements.size;
    return VK_SUCCESS;
  }
  void free(const HostMemory& memory) override {
    EXPECT_EQ(live.erase(memory.memory), 1u);
    context_.vk.vkFreeMemory(context_.device, memory.memory, nullptr);
  }
  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [memory, size] : live) sum += size;
    return sum;
  }

  std::map<VkDeviceMemory, std::uint64_t> live;
  std::uint64_t requests = 0;
  std::string most_name;
  bool refuses = false;

 private:
  vulkan::Context& context_;
};

TEST_F(HostMemoryTest, a_hosts_allocator_gives_all_memory_and_gets_it_back) {
  SimpleAllocator allocator(context());
  const test::CountingCallbacks callbacks;
  test::CallWatch watch;
  HostDevice host = lend();
  host.get_instance_proc_addr = test::CallWatch::loader();
  host.allocation_callbacks = callbacks.get();
  host.memory_allocator = &allocator;
  {
    const auto ours = test::value_of(create_vulkan_device_on(host));
    use_everything(*ours);
    EXPECT_EQ(allocator.bytes(), 0u) << "no empty blocks are kept";
    const BufferHandle device_local = test::value_of(make(*ours, 3000));
    const BufferHandle upload = test::value_of(make(*ours, 70 * kMiB, MemoryKind::upload));
    EXPECT_EQ(allocator.most_name, "test.bytes");
    ASSERT_EQ(allocator.live.size(), 2u);
    const MemoryTotals totals = ours->memory_totals();
    EXPECT_EQ(totals.used, allocator.bytes());
    EXPECT_EQ(totals.reserved, allocator.bytes());
    EXPECT_EQ(totals.blocks, 2u);
    std::memset(ours->mapped(upload).data(), 7, 4);
    const BufferHandle readback = test::make_readback(*ours, 4);
    test::run_frame(*ours, [&](CommandList& commands) {
      commands.copy_buffer(upload, 0, readback, 0, 4);
      to(commands, readback, Access::transfer_write, Access::host_read);
    });
    EXPECT_EQ(test::items_of<std::uint32_t>(*ours, readback).at(0), 0x07070707u);
    for (const BufferHandle buffer : {device_local, upload, readback}) ours->destroy(buffer);
    EXPECT_EQ(allocator.live.size(), 0u);
    static_cast<void>(test::value_of(make(*ours, 100)));  // left to the device's destructor
  }
  EXPECT_EQ(allocator.live.size(), 0u);
  EXPECT_GE(allocator.requests, 8u);
  EXPECT_EQ(watch.called().count("vkAllocateMemory"), 0u);
}

TEST_F(HostMemoryTest, a_refusal_of_the_hosts_allocator_is_an_error_that_names_the_object) {
  SimpleAllocator allocator(context());
  HostDevice host = lend();
  host.memory_allocator = &allocator;
  const auto ours = test::value_of(create_vulkan_device_on(host));
  allocator.refuses = true;
  const auto refused = make(*ours, 100);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("\"bytes\" of module \"test\""));
  allocator.refuses = false;
  EXPECT_TRUE(make(*ours, 100).ok());
}

TEST_F(HostMemoryTest, blocks_grow_up_to_their_size_and_reserved_bytes_count_them) {
  HostDevice host = lend();
  host.memory.block_bytes = 16 * kMiB;
  const auto ours = test::value_of(create_vulkan_device_on(host));
  EXPECT_EQ(ours->memory_totals().reserved, 0u);
  static_cast<void>(test::value_of(make(*ours, 1000)));
  EXPECT_EQ(ours->memory_totals().reserved, MemoryOptions::kLeastBlockBytes);
  for (int i = 0; i < 40; ++i) static_cast<void>(test::value_of(make(*ours, kMiB)));
  // 4 + 4 + 8 + 16 + 16 MiB.
  EXPECT_EQ(ours->memory_totals().reserved, 48 * kMiB);
  EXPECT_EQ(ours->memory_totals().blocks, 5u);
  EXPECT_GE(ours->memory_totals().used, 40 * kMiB);
  static_cast<void>(test::value_of(make(*ours, 9 * kMiB)));  // more than half a block: its own memory
  EXPECT_EQ(ours->memory_totals().reserved, 57 * kMiB);
  host.memory.block_bytes = kMiB;
  EXPECT_ASSERT(static_cast<void>(create_vulkan_device_on(host)), "MemoryOptions::block_bytes is at least");
}

TEST_F(HostMemoryTest, free_idle_memory_gives_back_every_empty_block) {
  const auto ours = test::value_of(create_vulkan_device_on(lend()));
  std::vector<BufferHandle> buffers;
  for (const MemoryKind kind : {MemoryKind::device, MemoryKind::upload, MemoryKind::readback})
    for (int i = 0; i < 3; ++i) buffers.push_back(test::value_of(make(*ours, 20 * kMiB, kind)));
  const BufferHandle stays = test::value_of(make(*ours, 1000));
  for (const BufferHandle buffer : buffers) ours->destroy(buffer);
  EXPECT_GT(ours->memory_totals().reserved, ours->memory_totals().used + 32 * kMiB) << "one block of a kind is kept";
  ours->free_idle_memory();
  EXPECT_EQ(ours->memory_totals().blocks, 1u) << "of the buffer that is alive";
  ours->destroy(stays);
  ours->free_idle_memory();
  EXPECT_EQ(ours->memory_totals().reserved, 0u);
}

TEST_F(HostMemoryTest, a_budget_bounds_what_is_reserved_and_is_named_when_it_is_full) {
  HostDevice host = lend();
  host.memory.budget_bytes = 48 * kMiB;
  const auto ours = test::value_of(create_vulkan_device_on(host));
  EXPECT_EQ(ours->memory_totals().budget, 48 * kMiB);
  const BufferHandle large = test::value_of(make(*ours, 40 * kMiB));
  const auto refused = make(*ours, 12 * kMiB);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("MemoryOptions::budget_bytes is 50331648"));
  // A block of 8 MiB fits exactly, and in place of a block that does not fit an object has its own memory.
  const BufferHandle small = test::value_of(make(*ours, 3 * kMiB));
  const BufferHandle smaller = test::value_of(make(*ours, 5 * kMiB));
  EXPECT_LE(ours->memory_totals().reserved, 48 * kMiB);
  for (const BufferHandle buffer : {large, small, smaller}) ours->destroy(buffer);
  // Empty blocks make room.
  EXPECT_TRUE(make(*ours, 47 * kMiB, MemoryKind::upload).ok());
  EXPECT_LE(ours->memory_totals().reserved, 48 * kMiB);
}

}  // namespace
}  // namespace gloam::gpu
