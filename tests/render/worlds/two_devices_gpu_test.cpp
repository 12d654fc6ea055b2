// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Two engines in one process, each with its Vulkan instance, device, renderer, world and threads, draw at once. They
// share the folder of compiled pipelines.
#include <gtest/gtest.h>

#include <array>
#include <barrier>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/render/draws/drawn_scene.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

constexpr int kFrames = 4;

/// What an engine has shown. Engines differ by `seed`, so that one that showed the other's world would be noticed.
struct Shown {
  std::vector<std::vector<std::uint8_t>> pictures;
  std::uint64_t validation_messages = 0;
};

Shown run_engine(std::uint32_t seed, const std::string& cache, const std::function<void()>& before_frame) {
  Shown shown;
  gpu::VulkanOptions options = test::test_device_options();
  options.cache_directory = cache;
  const auto device = test::make_test_device(true, options);
  const auto executor = make_pool_executor(2);
  RendererOptions renderer_options;
  renderer_options.device = device.get();
  renderer_options.executor = executor.get();
  renderer_options.log = &test::gpu_log();
  renderer_options.modules = make_all_modules();
  const auto renderer = test::value_of(Renderer::create(std::move(renderer_options)));
  World world;
  renderer->prepare_world(world);
  world.resource<SceneEnvironment>().has_exposure = true;
  test::fill_small_scene(world);
  static_cast<void>(test::add_lights(world));
  for (int frame = 0; frame < kFrames; ++frame) {
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0 + seed, 3.0, 9.0 - frame), dvec3(0.0), 64, 36);
    before_frame();
    const Status drawn = renderer->render(world, {&request, 1});
    EXPECT_TRUE(drawn.ok()) << drawn.error().message;
    shown.pictures.push_back(test::value_of(renderer->read_picture(ViewId{0})).rgba);
  }
  renderer->release_world(world);
  shown.validation_messages = device->validation_messages();
  return shown;
}

// Hard case: passes.two_engines
TEST(TwoDevices, that_draw_at_once_show_what_each_shows_alone) {
  {
    const auto device = test::make_test_device(false);
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }
  const test::TestFolder folder;
  std::array<Shown, 2> alone, together;
  for (std::uint32_t i = 0; i < 2; ++i) alone[i] = run_engine(i, folder.path(), [] {});
  std::barrier both(2);  // their frames begin at once
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < 2; ++i)
    threads.emplace_back([&, i] { together[i] = run_engine(i, folder.path(), [&] { both.arrive_and_wait(); }); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(alone[0].pictures, alone[1].pictures);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(together[i].pictures, alone[i].pictures) << "engine " << i;
    EXPECT_EQ(together[i].validation_messages, 0u) << "engine " << i;
  }
}

}  // namespace
}  // namespace gloam
