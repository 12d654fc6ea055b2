// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan_interop.h"

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "engine/gpu/access.h"
#include "engine/gpu/vulkan/device.h"
#include "engine/gpu/vulkan/startup/features.h"
#include "shaders/gpu_test/shaders.h"
#include "tests/gpu/vulkan/device_fixture.h"
#include "tests/support/expect_assert.h"
#include "tests/support/lent_device.h"

namespace gloam::gpu {
namespace {

/// The fixture's device acts as the host's device: a second gpu::Device is created on its handles.
class Interop : public VulkanTest {
 protected:
  [[nodiscard]] vulkan::Context& context() { return dynamic_cast<vulkan::VulkanDevice&>(device()).context(); }
  [[nodiscard]] HostDevice lend() { return test::lend(device(), features_); }
  [[nodiscard]] static std::string refusal_of(const HostDevice& host) {
    const auto refused = create_vulkan_device_on(host);
    EXPECT_FALSE(refused.ok());
    if (refused.ok()) return {};
    EXPECT_EQ(refused.error().kind, ErrorKind::no_device);
    return refused.error().message;
  }
  [[nodiscard]] VkImage raw(ImageHandle image) {
    return dynamic_cast<vulkan::VulkanDevice&>(device()).images().get(image).image;
  }
  [[nodiscard]] ImageHandle make_image(const ImageDesc& desc) { return test::value_of(device().create_image(desc)); }

  vulkan::Features features_;
};

ImageDesc small_image() {
  return {.name = "lent",
          .module = "test",
          .format = Format::rgba8_unorm,
          .width = 4,
          .height = 4,
          .usage = ImageUsage::transfer_source | ImageUsage::transfer_target};
}

TEST_F(Interop, a_hosts_device_says_what_it_is_and_outlives_ours) {
  {
    const auto ours = test::value_of(create_vulkan_device_on(lend()));
    ASSERT_NE(ours, nullptr);
    EXPECT_EQ(ours->info().name, device().info().name);
    EXPECT_EQ(ours->validation_messages(), 0u);
  }
  const BufferHandle buffer = test::make_readback(device(), 4);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.fill_buffer(buffer, 0, 4, 7);
    to(commands, buffer, Access::transfer_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), buffer).at(0), 7u);
}

TEST_F(Interop, an_imported_image_is_written_and_left_to_the_host) {
  const ImageHandle theirs = make_image(small_image());
  const auto ours = test::value_of(create_vulkan_device_on(lend()));
  const ImageHandle imported = import_image(*ours, raw(theirs), small_image());
  EXPECT_EQ(ours->desc(imported).width, 4u);
  test::run_frame(*ours, [&](CommandList& commands) {
    to(commands, imported, Access::none, Access::transfer_write);
    commands.clear_color_image(imported,
                               {std::bit_cast<std::uint32_t>(1.0f), 0, 0, std::bit_cast<std::uint32_t>(1.0f)});
    to(commands, imported, Access::transfer_write, Access::transfer_read);
  });
  ours->destroy(imported);
  BufferHandle bytes;
  test::run_frame(device(),
                  [&](CommandList& commands) { bytes = read_layer(commands, theirs, Access::transfer_read); });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), bytes).at(15), 0xFF0000FFu);
}

TEST_F(Interop, an_imported_buffer_is_used_by_both_and_outlives_its_handle) {
  const BufferHandle theirs = test::make_storage(device(), 64);
  const auto ours = test::value_of(create_vulkan_device_on(lend()));
  const BufferDesc desc{.name = "lent",
                        .module = "test",
                        .size = 64,
                        .usage = BufferUsage::transfer_source | BufferUsage::transfer_target | BufferUsage::storage};
  const BufferHandle imported = import_buffer(*ours, native_buffer(device(), theirs), desc);
  EXPECT_EQ(native_buffer(*ours, imported), native_buffer(device(), theirs));
  const auto before = ours->memory();
  const BufferHandle result = test::make_readback(*ours, 64);
  test::run_frame(*ours, [&](CommandList& commands) {
    commands.fill_buffer(imported, 0, 64, 5);
    to(commands, imported, Access::transfer_write, Access::transfer_write);
    {
      const NativeCommands native = native_commands(commands);
      const std::uint32_t seven = 7;
      reinterpret_cast<PFN_vkCmdUpdateBuffer>(
          context().instance_functions().vkGetDeviceProcAddr(context().device, "vkCmdUpdateBuffer"))(
          native.get(), native_buffer(*ours, imported), 4, sizeof(seven), &seven);
    }
    to(commands, imported, Access::transfer_write, Access::transfer_read);
    commands.copy_buffer(imported, 0, result, 0, 64);
    to(commands, result, Access::transfer_write, Access::host_read);
  });
  const auto read = test::items_of<std::uint32_t>(*ours, result);
  EXPECT_EQ(read.at(0), 5u);
  EXPECT_EQ(read.at(1), 7u);
  EXPECT_EQ(read.at(2), 5u);
  ours->destroy(imported);
  EXPECT_EQ(before.size(), 0u) << "a host's bytes are not gloam's";
  const BufferHandle again = test::make_readback(device(), 64);
  test::run_frame(device(), [&](CommandList& commands) {
    commands.copy_buffer(theirs, 0, again, 0, 64);
    to(commands, again, Access::transfer_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(device(), again).at(1), 7u);
}

TEST_F(Interop, a_frame_waits_for_the_hosts_semaphore_and_signals_another) {
  vulkan::Context& c = context();
  const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                          .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
  const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
  VkSemaphore go = VK_NULL_HANDLE, done = VK_NULL_HANDLE;
  ASSERT_EQ(c.vk.vkCreateSemaphore(c.device, &info, nullptr, &go), VK_SUCCESS);
  ASSERT_EQ(c.vk.vkCreateSemaphore(c.device, &info, nullptr, &done), VK_SUCCESS);
  const auto value_of = [&](VkSemaphore semaphore) {
    std::uint64_t value = 0;
    c.vk.vkGetSemaphoreCounterValue(c.device, semaphore, &value);
    return value;
  };
  const auto signal = reinterpret_cast<PFN_vkSignalSemaphore>(
      c.instance_functions().vkGetDeviceProcAddr(c.device, "vkSignalSemaphore"));
  {
    const auto ours = test::value_of(create_vulkan_device_on(lend()));
    EXPECT_EQ(frame_timeline(*ours).value, 0u);
    ASSERT_TRUE(ours->begin_frame().ok());
    const HostSemaphore wait = {go, 5};
    const HostSemaphore then = {done, 9};
    add_frame_semaphores(*ours, {&wait, 1}, {&then, 1});
    ASSERT_TRUE(ours->submit_frame().ok());
    EXPECT_EQ(value_of(done), 0u);
    EXPECT_EQ(ours->completed_frames(), 0u);
    const VkSemaphoreSignalInfo allow = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, .semaphore = go, .value = 5};
    ASSERT_EQ(signal(c.device, &allow), VK_SUCCESS);
    ASSERT_TRUE(ours->wait_idle().ok());
    EXPECT_EQ(value_of(done), 9u);
    EXPECT_EQ(frame_timeline(*ours).value, 1u);
    EXPECT_EQ(value_of(frame_timeline(*ours).semaphore), 1u);
    EXPECT_ASSERT(add_frame_semaphores(*ours, {&wait, 1}), "while it is recorded");
  }
  c.vk.vkDestroySemaphore(c.device, go, nullptr);
  c.vk.vkDestroySemaphore(c.device, done, nullptr);
}

TEST_F(Interop, a_host_that_enables_no_extension_is_taken) {
  HostDevice host = lend();
  host.enabled_extensions = {};
  const auto ours = test::value_of(create_vulkan_device_on(host));
  ASSERT_NE(ours, nullptr);
  const auto pipeline = test::value_of(ours->create_pipeline(
      ComputePipelineDesc{.name = "double", .module = "test", .shader = shaders::gpu_test::double_numbers_comp}));
  const BufferHandle source = test::make_upload(*ours, std::vector<std::uint32_t>{21});
  const BufferHandle uniform = test::make_upload(*ours, std::vector<std::uint32_t>{0});
  const BufferHandle target = test::make_readback(*ours, 4);
  test::run_frame(*ours, [&](CommandList& commands) {
    commands.bind_pipeline(pipeline);
    commands.bind(std::array{Binding{0, Binding::BufferRange{source}}, Binding{1, Binding::BufferRange{target}},
                             Binding{2, Binding::BufferRange{uniform}}});
    commands.push(std::uint32_t{1});
    commands.dispatch(1, 1, 1);
    to(commands, target, Access::compute_write, Access::host_read);
  });
  EXPECT_EQ(test::items_of<std::uint32_t>(*ours, target).at(0), 42u);
}

TEST_F(Interop, what_a_host_has_not_enabled_is_named) {
  HostDevice host = lend();
  features_.v12.timelineSemaphore = VK_FALSE;
  features_.core.features.shaderStorageImageExtendedFormats = VK_FALSE;
  const std::string message = refusal_of(host);
  EXPECT_NE(message.find("shaderStorageImageExtendedFormats, timelineSemaphore"), std::string::npos) << message;
  EXPECT_EQ(message.find("dynamicRendering"), std::string::npos) << message;
}

TEST_F(Interop, a_host_of_an_older_vulkan_or_with_another_queue_family_is_refused) {
  HostDevice host = lend();
  host.api_version = VK_API_VERSION_1_2;
  EXPECT_NE(refusal_of(host).find("1.3"), std::string::npos);
  host = lend();
  host.queue_family = 100;
  EXPECT_NE(refusal_of(host).find("queue family 100"), std::string::npos);
}

TEST(HostFeatures, the_structures_of_single_features_count) {
  VkPhysicalDeviceVulkan12Features v12 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  VkPhysicalDeviceVulkan13Features v13 = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceFeatures2 chain = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  EXPECT_NE(vulkan::missing_features(vulkan::features_of_chain(chain)), "");
  fill_required_features(chain.features, v12, v13);
  VkPhysicalDeviceMaintenance4Features maintenance = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES,
                                                      .maintenance4 = VK_TRUE};
  VkPhysicalDeviceSynchronization2Features synchronization = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
      .pNext = &maintenance,
      .synchronization2 = VK_TRUE};
  VkPhysicalDeviceDynamicRenderingFeatures rendering = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
      .pNext = &synchronization,
      .dynamicRendering = VK_TRUE};
  v12.pNext = &rendering;
  chain.pNext = &v12;
  EXPECT_EQ(vulkan::missing_features(vulkan::features_of_chain(chain)), "");
}

TEST_F(Interop, native_views_show_images_of_every_shape) {
  const auto shaped = [&](ImageShape shape, std::uint32_t layers, std::uint32_t depth) {
    ImageDesc desc = small_image();
    desc.usage = ImageUsage::sampled;
    desc.shape = shape;
    desc.layers = layers;
    desc.depth = depth;
    return make_image(desc);
  };
  for (const auto& [image, layer_count] :
       {std::pair(shaped(ImageShape::plain, 1, 1), 1u), std::pair(shaped(ImageShape::array, 3, 1), 2u),
        std::pair(shaped(ImageShape::cube, 6, 1), 6u), std::pair(shaped(ImageShape::volume, 1, 4), 1u)}) {
    const ImageView view{.image = image, .layer_count = layer_count};
    const VkImageView native = test::value_of(native_view(device(), view));
    EXPECT_NE(native, VkImageView{});
    EXPECT_EQ(test::value_of(native_view(device(), view)), native) << "it is made once";
  }
  const ImageView absent{.image = make_image(small_image()), .first_layer = 3};
  EXPECT_ASSERT((void)native_view(device(), absent), "a range begins inside its image");
}

TEST(HostBufferAccesses, are_those_of_buffers) {
  for (std::uint32_t a = 0; a <= static_cast<std::uint32_t>(Access::present); ++a) {
    const auto access = static_cast<Access>(a);
    if (access != Access::none && !fits_buffer(access)) {
      EXPECT_ASSERT((void)host_buffer_access(access), "buffers can have");
      continue;
    }
    EXPECT_EQ(host_buffer_access(access).stages == VK_PIPELINE_STAGE_2_NONE, access == Access::none) << name_of(access);
  }
  EXPECT_EQ(host_buffer_access(Access::vertex_input).access,
            VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT);
  EXPECT_EQ(native_format(Format::d32_float), VK_FORMAT_D32_SFLOAT);
}

TEST(HostImageLayouts, agree_with_the_layouts_that_accesses_share) {
  for (std::uint32_t a = 0; a <= static_cast<std::uint32_t>(Access::present); ++a) {
    const auto access = static_cast<Access>(a);
    if (access != Access::none && !fits_image(access)) {
      EXPECT_ASSERT((void)host_image_layout(access), "images can have");
      continue;
    }
    const HostImageLayout one = host_image_layout(access);
    EXPECT_EQ(one.layout == VK_IMAGE_LAYOUT_UNDEFINED, access == Access::none) << name_of(access);
    for (std::uint32_t b = 1; b <= static_cast<std::uint32_t>(Access::present); ++b) {
      const auto other = static_cast<Access>(b);
      if (!fits_image(other) || layout_of(access) != layout_of(other)) continue;
      EXPECT_EQ(one.layout, host_image_layout(other).layout) << name_of(access) << ", " << name_of(other);
    }
  }
}

}  // namespace
}  // namespace gloam::gpu
