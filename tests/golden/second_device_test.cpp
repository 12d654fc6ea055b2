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

/// Both devices draw all scenes and keep their pipelines, whose compilation takes most of the time.
class SecondDevice : public testing::TestWithParam<std::string> {
 protected:
  static void SetUpTestSuite() {
    first = device_named("llvmpipe");
    second = device_named("swiftshader");
  }
  static void TearDownTestSuite() {
    first.reset();
    second.reset();
  }
  [[nodiscard]] static std::shared_ptr<gpu::Device> device_named(const char* name) {
    gpu::VulkanOptions options = test_device_options();
    options.device = name;
    return make_test_device(true, options);
  }

  inline static std::shared_ptr<gpu::Device> first, second;
};

// Hard case: passes.second_device
TEST_P(SecondDevice, draws_the_picture_of_the_first) {
  if (first == nullptr || second == nullptr)
    GTEST_SKIP()
        << "there is no usable Vulkan device of SwiftShader and lavapipe (Debian's chromium brings SwiftShader)";
  const Picture wanted = draw_scene(first, GetParam(), {}, 360);
  const Picture found = draw_scene(second, GetParam(), {}, 360);
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

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.push_back("builtin:" + std::string(scene.name));
  return names;
}
INSTANTIATE_TEST_SUITE_P(Scenes, SecondDevice, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.substr(8); });

}  // namespace
}  // namespace gloam::test
