// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "sandbox/scenes/builtin.h"
#include "tests/golden/whole_pictures.h"

// Draws one frame of each built-in scene on SwiftShader and on lavapipe: two drivers, compilers and subgroup widths.

namespace gloam::test {
namespace {

[[nodiscard]] std::unique_ptr<gpu::Device> device_named(const char* name) {
  gpu::VulkanOptions options = test_device_options();
  options.device = name;
  return make_test_device(true, options);
}

class SecondDevice : public testing::TestWithParam<std::string> {};

TEST_P(SecondDevice, draws_the_picture_of_the_first) {
  auto first = device_named("llvmpipe");
  auto second = device_named("swiftshader");
  if (first == nullptr || second == nullptr)
    GTEST_SKIP()
        << "there is no usable Vulkan device of SwiftShader and lavapipe (Debian's chromium brings SwiftShader)";
  const Picture expected = draw_scene(std::move(first), GetParam(), {});
  const Picture picture = draw_scene(std::move(second), GetParam(), {});
  ASSERT_EQ(picture.rgba.size(), expected.rgba.size());
  ASSERT_FALSE(picture.rgba.empty());
  // Edges of triangles and of shadows may fall on either side of a pixel's centre.
  EXPECT_LT(root_mean_square(picture.rgba, expected.rgba), 0.01);
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
