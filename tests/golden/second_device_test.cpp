// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "sandbox/scenes/builtin.h"
#include "tests/golden/whole_pictures.h"

// Draws one frame of each built-in scene on SwiftShader and on lavapipe: two drivers, compilers and subgroup widths.
// Only the shaders of shadow filters are left out, and the screen-space reflections of glass.

namespace gloam::test {
namespace {

[[nodiscard]] std::unique_ptr<gpu::Device> device_named(const char* name) {
  gpu::VulkanOptions options = test_device_options();
  options.device = name;
  return make_test_device(true, options);
}

class SecondDevice : public testing::TestWithParam<std::string> {};

// Hard case: passes.second_device
TEST_P(SecondDevice, draws_the_picture_of_the_first) {
  auto first = device_named("llvmpipe");
  auto second = device_named("swiftshader");
  if (first == nullptr || second == nullptr)
    GTEST_SKIP()
        << "there is no usable Vulkan device of SwiftShader and lavapipe (Debian's chromium brings SwiftShader)";
  // Shadow filters have more branches than SwiftShader compiles, see the next test; so have the rays of glass.
  std::vector<std::string> settings = {"shadows.mode=off"};
  if (GetParam() == "builtin:dusk") settings.emplace_back("reflections.tiers=ibr+cube");
  const Picture wanted = draw_scene(std::move(first), GetParam(), settings, 360);
  const Picture found = draw_scene(std::move(second), GetParam(), settings, 360);
  ASSERT_EQ(found.rgba.size(), wanted.rgba.size());
  ASSERT_FALSE(found.rgba.empty());
  // The devices place edges of triangles on grids of different subpixels. Lamps and blades of grass that are about one
  // pixel wide are hit by one grid and missed by the other, so means of 4 × 4 pixels are compared: a pixel of another
  // blade changes a mean by up to 6.
  const Picture picture = reduced(found, 4), expected = reduced(wanted, 4);
  constexpr int kSteps = 6;
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  EXPECT_LE(share_unlike_neighbours(picture.rgba, expected.rgba, width, height, kSteps), 0.003);
  EXPECT_LE(share_unlike_neighbours(expected.rgba, picture.rgba, width, height, kSteps), 0.003);
}

TEST(SecondDeviceRefuses, shaders_that_its_compiler_does_not_end_at) {
  auto device = device_named("swiftshader");
  if (device == nullptr) GTEST_SKIP() << "there is no usable Vulkan device of SwiftShader";
  Options options;
  options.scene = "builtin:shadows";
  options.width = 480;
  options.height = 270;
  auto session = open_session_on(std::move(device), options, gpu_log());
  ASSERT_TRUE(session.ok()) << session.error().message;
  Session& s = **session;
  const ViewRequest request{s.view_settings(options.width, options.height, options.view), {}};
  const auto sample = s.render_frame(request);
  ASSERT_FALSE(sample.ok());
  EXPECT_EQ(sample.error().kind, ErrorKind::no_device);
  EXPECT_NE(sample.error().message.find("does not end at shader"), std::string::npos) << sample.error().message;
}

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back("builtin:" + std::string(scene.name));
  return names;
}
INSTANTIATE_TEST_SUITE_P(Scenes, SecondDevice, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.substr(8); });

}  // namespace
}  // namespace gloam::test
