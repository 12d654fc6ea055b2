// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "sandbox/session/session.h"
#include "tests/golden/whole_pictures.h"
#include "tests/support/gpu_device.h"

// Whole frames on one device, with the choices that the engine makes by the kind of device overridden.

namespace gloam::test {
namespace {

class DeviceVariants : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto device = make_test_device(false);
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }

  [[nodiscard]] static Picture draw(gpu::VulkanOptions device) {
    return draw_scene(make_test_device(true, std::move(device)), GetParam(), {});
  }
};

// Hard case: passes.descriptor_pools
TEST_P(DeviceVariants, pools_of_descriptor_sets_draw_the_picture_of_push_descriptors) {
  gpu::VulkanOptions options = test_device_options();
  options.push_descriptors = gpu::PushDescriptors::automatic;
  const Picture pushed = draw(options);
  options.push_descriptors = gpu::PushDescriptors::never;
  EXPECT_EQ(draw(options).rgba, pushed.rgba);
}

TEST_P(DeviceVariants, kernels_for_threads_together_draw_the_picture_of_those_for_threads_in_turn) {
  gpu::VulkanOptions options = test_device_options();
  options.threads_in_turn = true;
  const Picture in_turn = draw(options);
  options.threads_in_turn = false;
  EXPECT_EQ(draw(options).rgba, in_turn.rgba);
}

TEST_P(DeviceVariants, split_shaders_draw_the_picture_of_whole_ones) {
  gpu::VulkanOptions options = test_device_options();
  options.split_selections = false;
  const Picture whole = draw(options);
  options.split_selections = true;
  EXPECT_EQ(draw(options).rgba, whole.rgba);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DeviceVariants,
                         testing::Values("builtin:many_lights", "builtin:shadows", "builtin:closeups"),
                         [](const auto& scene) { return std::string(scene.param).substr(8); });

}  // namespace
}  // namespace gloam::test
