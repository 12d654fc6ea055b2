// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/swapchain.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "tests/gpu/vulkan/test_window.h"

namespace gloam::gpu {
namespace {

class WindowTest : public WindowFixture {
 protected:
  void SetUp() override {
    WindowFixture::SetUp();
    if (!device_) return;
    auto swapchain = create_swapchain(*device_, window_.options().create_surface);
    ASSERT_TRUE(swapchain.ok()) << swapchain.error().message;
    swapchain_ = std::move(*swapchain);
  }
  void TearDown() override {
    swapchain_.reset();
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), 0u);
    }
    device_.reset();
  }

  /// Shows one frame of one colour; returns its image, or none if there is nothing to draw to.
  ImageHandle show() {
    const auto commands = device_->begin_frame();
    EXPECT_TRUE(commands.ok()) << commands.error().message;
    const auto image = swapchain_->acquire();
    EXPECT_TRUE(image.ok()) << image.error().message;
    if (*image) {
      const ImageBarrier fill = {.image = *image, .after = Access::transfer_write};
      (*commands)->barrier({}, {&fill, 1});
      (*commands)->clear_color_image(*image, {0x3f800000u, 0u, 0u, 0x3f800000u});
      const ImageBarrier present = {.image = *image, .before = Access::transfer_write, .after = Access::present};
      (*commands)->barrier({}, {&present, 1});
    }
    EXPECT_TRUE(device_->submit_frame().ok());
    EXPECT_TRUE(swapchain_->present().ok());
    return *image;
  }

  std::unique_ptr<Swapchain> swapchain_;
};

TEST_F(WindowTest, shows_frame_after_frame_in_pictures_of_its_size) {
  ASSERT_TRUE(swapchain_->resize(200, 100).ok());
  for (int i = 0; i < 8; ++i) {
    const ImageHandle image = show();
    ASSERT_TRUE(image);
    EXPECT_EQ(device_->desc(image).width, 200u);
    EXPECT_EQ(device_->desc(image).height, 100u);
  }
}

TEST_F(WindowTest, shows_the_picture_of_an_abandoned_frame_in_the_next_one) {
  ASSERT_TRUE(swapchain_->resize(200, 100).ok());
  ASSERT_TRUE(show());
  for (int round = 0; round < 4; ++round) {
    ImageHandle image;
    for (int attempt = 0; attempt < 2; ++attempt) {
      ASSERT_TRUE(device_->begin_frame().ok());
      const auto acquired = swapchain_->acquire();
      ASSERT_TRUE(acquired.ok());
      EXPECT_TRUE(attempt == 0 || *acquired == image);
      image = *acquired;
      ASSERT_TRUE(device_->abandon_frame().ok());
    }
    EXPECT_EQ(show(), image);
    EXPECT_TRUE(show());
  }
}

TEST_F(WindowTest, follows_a_new_size_and_gives_nothing_while_minimised) {
  EXPECT_FALSE(show());  // resize was never called
  ASSERT_TRUE(swapchain_->resize(200, 100).ok());
  EXPECT_TRUE(show());
  ASSERT_TRUE(swapchain_->resize(0, 0).ok());
  EXPECT_FALSE(show());
  glfwSetWindowSize(window_.get(), 320, 240);
  glfwPollEvents();
  for (int attempt = 0; attempt < 50; ++attempt) {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_.get(), &width, &height);
    ASSERT_TRUE(swapchain_->resize(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)).ok());
    const ImageHandle image = show();
    if (image && device_->desc(image).width == 320) return;
    glfwPollEvents();
  }
  FAIL() << "the pictures never had the window's size";
}

}  // namespace
}  // namespace gloam::gpu
