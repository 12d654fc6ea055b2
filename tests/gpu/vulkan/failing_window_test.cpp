// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Each call of Vulkan that can fail does, while gloam makes its instance, its device and the pictures of a window, and
// shows them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/vulkan/startup/functions.h"
#include "tests/gpu/vulkan/test_window.h"
#include "tests/support/failing_calls.h"

namespace gloam::gpu {
namespace {

constexpr int kShown = 3;

/// What the program of a window has been told, and how many frames it has shown.
struct WindowLife {
  std::vector<std::string> errors;
  bool opened = false;  ///< device and swapchain were made
  int shown = 0;
  int validation_messages = 0;  ///< of the whole life of the device
};

class FailingWindow : public WindowFixture {
 protected:
  static bool note(WindowLife& life, const Status& status) {
    if (!status.ok()) life.errors.push_back(status.error().message);
    return status.ok();
  }
  /// Shows one frame. Returns whether it was shown.
  static bool show(WindowLife& life, Device& device, Swapchain& swapchain) {
    const auto commands = device.begin_frame();
    if (!commands) return note(life, commands.error());
    const auto image = swapchain.acquire();
    if (!image || !*image) {
      if (!image) static_cast<void>(note(life, image.error()));
      if (note(life, device.abandon_frame())) static_cast<void>(note(life, swapchain.resize(200, 100)));
      return false;
    }
    const ImageBarrier fill = {.image = *image, .after = Access::transfer_write};
    (*commands)->barrier({}, {&fill, 1});
    (*commands)->clear_color_image(*image, {0x3f800000u, 0u, 0u, 0x3f800000u});
    const ImageBarrier present = {.image = *image, .before = Access::transfer_write, .after = Access::present};
    (*commands)->barrier({}, {&present, 1});
    if (note(life, device.submit_frame())) return note(life, swapchain.present());
    // The program reads something back before it shows the next frame.
    if (note(life, begin_side_frame(device))) static_cast<void>(note(life, device.submit_frame()));
    return false;
  }
  static Status begin_side_frame(Device& device) {
    const auto commands = device.begin_side_frame();
    return commands ? Status() : Status(commands.error());
  }
  /// Opens a window's device and shows frames, at most twice as many as it must show.
  WindowLife live() {
    WindowLife life;
    FunctionLog log([&](LogLevel, std::string_view line) {
      if (line.find("Vulkan: ") != std::string_view::npos) ++life.validation_messages;
    });
    VulkanOptions options = window_.options();
    options.log = &log;
    options.get_instance_proc_addr = reinterpret_cast<void (*)()>(test::FailingCalls::loader());
    auto device = create_vulkan_device(options);
    if (!device) {
      life.errors.push_back(device.error().message);
      return life;
    }
    auto swapchain = create_swapchain(**device, options.create_surface);
    if (!swapchain) {
      life.errors.push_back(swapchain.error().message);
    } else {
      life.opened = true;
      static_cast<void>(note(life, (*swapchain)->resize(200, 100)));
      for (int frame = 0; frame < 2 * kShown && life.shown < kShown; ++frame)
        life.shown += show(life, **device, **swapchain) ? 1 : 0;
    }
    if (swapchain) swapchain->reset();
    device->reset();
    return life;
  }
};

// Hard case: passes.failing_call
TEST_F(FailingWindow, tells_what_failed_and_shows_the_next_frames) {
  test::FailingCalls failing(vulkan::find_loader());
  failing.begin();
  const WindowLife undisturbed = live();
  ASSERT_TRUE(undisturbed.errors.empty()) << undisturbed.errors.front();
  ASSERT_EQ(undisturbed.shown, kShown);
  ASSERT_EQ(undisturbed.validation_messages, 0);
  const std::vector<test::FailingCalls::Call> calls = failing.calls();
  for (const char* function : {"vkCreateInstance", "vkEnumeratePhysicalDevices", "vkCreateDevice",
                               "vkCreateSwapchainKHR", "vkAcquireNextImageKHR", "vkQueuePresentKHR"})
    EXPECT_THAT(calls, ::testing::Contains(::testing::Field(&test::FailingCalls::Call::function, function)));
  for (std::size_t call = 0; call < calls.size(); ++call) {
    const std::string& function = calls[call].function;
    std::vector<std::pair<VkResult, std::string>> results = {{VK_ERROR_OUT_OF_HOST_MEMORY, "out of host memory"}};
    if (test::FailingCalls::can_lose_device(function)) results.push_back({VK_ERROR_DEVICE_LOST, "the device was lost"});
    for (const auto& [result, words] : results) {
      SCOPED_TRACE(function + ", call " + std::to_string(call) + ": " + words);
      failing.begin(call, result);
      const WindowLife life = live();
      EXPECT_TRUE(failing.has_failed());
      EXPECT_EQ(life.validation_messages, 0);
      // Either nothing was lost by the failure, or an error tells of it, and the next frames are shown.
      EXPECT_TRUE(life.shown == kShown || !life.errors.empty());
      if (life.opened && result != VK_ERROR_DEVICE_LOST) {
        EXPECT_EQ(life.shown, kShown);
      }
      if (!life.errors.empty()) {
        EXPECT_THAT(life.errors.front(), ::testing::HasSubstr(words));
      }
      if (result != VK_ERROR_DEVICE_LOST) {
        EXPECT_LE(life.errors.size(), 1u);
      }
    }
  }
}

}  // namespace
}  // namespace gloam::gpu
