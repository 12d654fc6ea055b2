// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/ecs/world.h"
#include "modules/fog/components.h"
#include "tests/golden/whole_pictures.h"
#include "tests/support/cube_capture.h"

// A cube capture of a whole scene with all modules.

namespace gloam::test {
namespace {

std::unique_ptr<Session> open_plain() {
  Options options;
  options.scene = "builtin:plain";
  auto device = make_test_device();
  if (device == nullptr) return nullptr;
  auto session = open_session_on(std::move(device), options, gpu_log());
  EXPECT_TRUE(session.ok()) << session.error().message;
  return session ? std::move(*session) : nullptr;
}

TEST(CubeCapture, of_a_scene_with_fog_equals_six_renders_without_fog_to_the_bit) {
  {
    const auto device = make_test_device(false);
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }
  const std::unique_ptr<Session> capturing = open_plain(), rendering = open_plain();
  ASSERT_TRUE(capturing != nullptr && rendering != nullptr);
  capturing->world.create(WorldTransform{}, Fog{.density = 0.05f, .color = vec3(2.0f, 3.0f, 4.0f)});
  const std::array<ViewSettings, 6> faces = cube_faces(dvec3(0.4, 1.5, 2.0));

  const gpu::ImageHandle cube = make_cube(*capturing->device, 1);
  const Status captured = capturing->renderer->render(capturing->world, captures_of(faces, cube));
  ASSERT_TRUE(captured.ok()) << captured.error().message;

  double brightest = 0.0;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::vector<std::uint16_t> texels = layer_of(*capturing->device, cube, i);
    ViewRequest request;
    request.settings = faces[i];
    request.settings.without = {"reflections"};  // captures have none
    const Status rendered = rendering->renderer->render(rendering->world, std::vector{request});
    ASSERT_TRUE(rendered.ok()) << rendered.error().message;
    const LinearPicture picture = value_of(rendering->renderer->read_linear(faces[i].id));
    ASSERT_EQ(picture.rgba.size(), texels.size());
    std::size_t different = 0;
    for (std::size_t t = 0; t < texels.size(); ++t) {
      different += float_of(texels[t]) != picture.rgba[t] ? 1 : 0;
      if (t % 4 == 0) brightest = std::max(brightest, static_cast<double>(picture.rgba[t]));
    }
    EXPECT_EQ(different, 0u) << "face " << i;
  }
  EXPECT_GT(brightest, 0.1);
  capturing->device->destroy(cube);
  EXPECT_TRUE(capturing->check_validation().ok());
}

}  // namespace
}  // namespace gloam::test
