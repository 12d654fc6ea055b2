// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/renderer.h"
#include "engine/scene/resources.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"
#include "tests/render/draws/small_scene.h"
#include "tests/support/gpu_device.h"

namespace gloam {
namespace {

constexpr int kFrames = 3;
using Pixels = std::vector<std::uint8_t>;

/// World 0 has the lights of add_lights and a metered exposure. World 1 has other lamps, one more box, another sky and
/// a fixed exposure.
void fill(World& world, std::uint32_t which) {
  test::fill_small_scene(world);
  std::vector<Entity> lights;
  auto& environment = world.resource<SceneEnvironment>();
  if (which == 0) {
    lights = test::add_lights(world);
    environment.sky_horizon = vec3(4.0f, 3.0f, 2.0f);
  } else {
    for (int i = 0; i < 12; ++i) {
      Light lamp;
      lamp.intensity = 20.0f + static_cast<float>(i);
      lamp.color = vec3(1.0f, 0.1f * static_cast<float>(i), 0.3f);
      const double angle = 0.5 * i;
      lights.push_back(world.create(
          WorldTransform{glm::translate(dmat4(1.0), dvec3(3.0 * std::cos(angle), 1.0, 3.0 * std::sin(angle)))}, lamp));
    }
    test::SceneMaker scene(world);
    scene.draw(scene.mesh(test::box(vec3(0.4f, 2.0f, 0.4f))), glm::translate(dmat4(1.0), dvec3(1.0, 1.0, -1.0)));
    environment.sky_zenith = vec3(1.0f, 5.0f, 2.0f);
    environment.has_exposure = true;
    environment.exposure_ev100 = 3.0f;
  }
  for (const Entity light : lights) world.add<ShadowCaster>(light, {.enabled = false});
}

/// Changes the world from frame to frame: raises the first drawn entity and sets the clock.
void step(World& world, int frame) {
  bool first = true;
  world.view<const MeshInstance, WorldTransform>().each([&](const MeshInstance&, WorldTransform& transform) {
    if (std::exchange(first, false)) transform.matrix[3].y += 0.05 * (frame + 1);
  });
  world.resource<SceneClock>().time_s = frame / 60.0;
}

ViewRequest request(std::uint32_t world, std::uint32_t view) {
  const dvec3 eye = view == 0 ? dvec3(2.0, 3.0, 9.0) : dvec3(-6.0, 2.0, 5.0);
  ViewRequest request;
  request.settings = test::look_at(eye, dvec3(0.0), 96 + 32 * view, 64 + 8 * world);
  request.settings.id = ViewId{view};
  return request;
}

class TwoWorlds : public ::testing::Test {
 protected:
  void SetUp() override {
    device_ = test::make_test_device();
    GLOAM_REQUIRE_GPU(device_);
    executor_ = make_pool_executor(2);
  }
  void TearDown() override {
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), 0u);
    }
  }

  [[nodiscard]] std::unique_ptr<Renderer> make_renderer() {
    RendererOptions options;
    options.device = device_.get();
    options.executor = executor_.get();
    options.modules = make_all_modules();
    return Renderer::create(std::move(options)).value();
  }

  static void draw(Renderer& renderer, World& world, const std::vector<ViewRequest>& views) {
    const Status status = renderer.render(world, views);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  [[nodiscard]] static Pixels pixels_of(Renderer& renderer, std::uint32_t view) {
    auto picture = renderer.read_picture(ViewId{view});
    EXPECT_TRUE(picture.ok()) << picture.error().message;
    return picture.ok() ? std::move(picture->rgba) : Pixels();
  }

  /// The picture of the last frame from another renderer that draws only this world and view.
  [[nodiscard]] Pixels alone(std::uint32_t which, std::uint32_t view) {
    const auto renderer = make_renderer();
    World world;
    renderer->prepare_world(world);
    fill(world, which);
    for (int frame = 0; frame < kFrames; ++frame) {
      step(world, frame);
      draw(*renderer, world, {request(which, view)});
    }
    return pixels_of(*renderer, view);
  }

  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<JobExecutor> executor_;
};

TEST_F(TwoWorlds, with_two_views_each_equal_four_single_runs) {
  const auto renderer = make_renderer();
  std::array<World, 2> worlds;
  for (std::uint32_t w = 0; w < 2; ++w) {
    renderer->prepare_world(worlds[w]);
    fill(worlds[w], w);
  }
  Pixels together[2][2];
  for (int frame = 0; frame < kFrames; ++frame) {
    for (std::uint32_t w = 0; w < 2; ++w) {
      step(worlds[w], frame);
      draw(*renderer, worlds[w], {request(w, 0), request(w, 1)});
      for (std::uint32_t v = 0; v < 2; ++v) together[w][v] = pixels_of(*renderer, v);
    }
  }
  for (std::uint32_t w = 0; w < 2; ++w) {
    for (std::uint32_t v = 0; v < 2; ++v) {
      EXPECT_TRUE(together[w][v] == alone(w, v)) << "world " << w << ", view " << v;
    }
  }
  EXPECT_TRUE(together[0][0] != together[0][1] && together[0][0] != together[1][0]) << "the pictures show nothing";
}

TEST_F(TwoWorlds, one_can_go_and_leave_the_other_as_it_is) {
  const auto renderer = make_renderer();
  World stays;
  renderer->prepare_world(stays);
  fill(stays, 0);
  for (int frame = 0; frame < kFrames; ++frame) {
    step(stays, frame);
    draw(*renderer, stays, {request(0, 1)});
    World passing;
    renderer->prepare_world(passing);
    fill(passing, 1);
    draw(*renderer, passing, {request(0, 0)});
    renderer->release_world(passing);
  }
  EXPECT_TRUE(pixels_of(*renderer, 1) == alone(0, 1));
}

TEST_F(TwoWorlds, that_go_give_their_memory_back) {
  const auto renderer = make_renderer();
  std::vector<std::uint64_t> bytes;
  for (int i = 0; i < 8; ++i) {
    World passing;
    renderer->prepare_world(passing);
    fill(passing, 1);
    draw(*renderer, passing, {request(0, 0)});
    renderer->release_world(passing);
    ASSERT_TRUE(renderer->wait().ok());
    bytes.push_back(renderer->report().modules.front().gpu_bytes);
  }
  EXPECT_EQ(bytes[7], bytes[4]);  // the first worlds still fill the rings of the frames in flight
}

TEST_F(TwoWorlds, can_each_have_a_renderer_on_one_device) {
  const std::unique_ptr<Renderer> renderers[] = {make_renderer(), make_renderer()};
  std::array<World, 2> worlds;
  for (std::uint32_t w = 0; w < 2; ++w) {
    renderers[w]->prepare_world(worlds[w]);
    fill(worlds[w], w);
  }
  for (int frame = 0; frame < kFrames; ++frame) {
    for (std::uint32_t w = 0; w < 2; ++w) {
      step(worlds[w], frame);
      draw(*renderers[w], worlds[w], {request(w, 0), request(w, 1)});
    }
  }
  for (std::uint32_t w = 0; w < 2; ++w) {
    for (std::uint32_t v = 0; v < 2; ++v) {
      EXPECT_TRUE(pixels_of(*renderers[w], v) == alone(w, v)) << "world " << w << ", view " << v;
    }
  }
}

TEST_F(TwoWorlds, go_on_after_a_frame_that_could_not_be_drawn) {
  const auto renderer = make_renderer();
  World world;
  renderer->prepare_world(world);
  fill(world, 0);
  ViewRequest broken = request(0, 0);
  broken.target.acquire = []() -> Result<gpu::ImageHandle> { return Error{ErrorKind::failed, "the window is gone"}; };
  const Status refused = renderer->render(world, {&broken, 1});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "the window is gone");
  for (int frame = 0; frame < kFrames; ++frame) {
    step(world, frame);
    draw(*renderer, world, {request(0, 0)});
  }
  EXPECT_TRUE(pixels_of(*renderer, 0) == alone(0, 0));
}

}  // namespace
}  // namespace gloam
