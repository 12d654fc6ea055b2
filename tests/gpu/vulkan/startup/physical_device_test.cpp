// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/startup/physical_device.h"

#include <cstring>
#include <string>

#include "engine/gpu/vulkan/device.h"
#include "tests/gpu/vulkan/device_fixture.h"

namespace gloam::gpu::vulkan {
namespace {

/// The window system of these tests: whether every queue family can present to every surface.
VkBool32 presents = VK_FALSE;

VKAPI_ATTR VkResult VKAPI_CALL surface_support(VkPhysicalDevice, std::uint32_t, VkSurfaceKHR, VkBool32* supported) {
  *supported = presents;
  return VK_SUCCESS;
}

/// The loader's functions, except for the question whether a device can present.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_with_surfaces(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetPhysicalDeviceSurfaceSupportKHR") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(&surface_support);
  return find_loader()(instance, name);
}

class ChoosingForAWindow : public VulkanTest {
 protected:
  [[nodiscard]] Result<PhysicalDevice> choose(bool can_present) {
    presents = can_present ? VK_TRUE : VK_FALSE;
    HostDevice host;
    host.instance = dynamic_cast<VulkanDevice&>(device()).context().instance();
    host.get_instance_proc_addr = &get_with_surfaces;
    const auto instance = Instance::adopt(host);
    if (!instance) return instance.error();
    const WindowNeeds window = {.present = true, .surface = (VkSurfaceKHR)std::uint64_t{1}};
    return choose_physical_device(**instance, "auto", window);
  }
};

TEST_F(ChoosingForAWindow, takes_a_device_that_can_present_to_it) {
  const auto chosen = choose(true);
  ASSERT_TRUE(chosen.ok()) << chosen.error().message;
  EXPECT_TRUE(chosen->can_present);
}

// Hard case: passes.present
TEST_F(ChoosingForAWindow, refuses_devices_that_cannot_present_to_it) {
  const auto chosen = choose(false);
  ASSERT_FALSE(chosen.ok());
  EXPECT_EQ(chosen.error().kind, ErrorKind::no_device);
  EXPECT_NE(chosen.error().message.find("a queue that can present to this window"), std::string::npos)
      << chosen.error().message;
}

}  // namespace
}  // namespace gloam::gpu::vulkan
