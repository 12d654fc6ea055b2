// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Memory of many views, and of devices, worlds and views that come and go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "modules/shadows/components.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/support/counted_memory.h"
#include "tests/support/lent_device.h"

namespace gloam {
namespace {

/// A renderer and a world with lamps, a sun and their shadows.
struct Host {
  Host(gpu::Device& device, ModuleList modules) {
    RendererOptions options;
    options.device = &device;
    options.executor = executor.get();
    options.log = &test::gpu_log();
    options.modules = std::move(modules);
    renderer = test::value_of(Renderer::create(std::move(options)));
    renderer->prepare_world(world);
    world.resource<SceneEnvironment>().has_exposure = true;
    test::fill_small_scene(world);
    static_cast<void>(test::add_lights(world));
  }
  /// Cameras on a circle around the scene.
  static ViewRequest view(std::uint32_t index) {
    ViewRequest request;
    const double angle = 0.1 * index;
    request.settings = test::look_at(dvec3(7.0 * std::sin(angle), 2.0, 7.0 * std::cos(angle)), dvec3(0.0), 32, 18);
    request.settings.id = ViewId{index};
    return request;
  }
  void move_a_caster() {
    bool moved = false;
    world.view<WorldTransform, const MeshInstance>().each([&](WorldTransform& transform, const MeshInstance&) {
      if (!moved) transform.matrix[3].y += 0.25;
      moved = true;
    });
  }
  void draw(const std::vector<ViewRequest>& requests) {
    const Status drawn = renderer->render(world, requests);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
};

std::uint64_t bytes_of(gpu::Device& device, std::string_view module) {
  for (const gpu::ModuleMemory& memory : device.memory())
    if (memory.module == module) return memory.bytes;
  return 0;
}

class ManyViews : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(test::drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(test::drawing_device());
  }
  void TearDown() override {
    if (test::drawing_device() != nullptr) {
      EXPECT_EQ(test::drawing_device()->validation_messages(), 0u);
    }
  }
};

/// The pictures of all views after the last frame, and the memory of all that was used.
struct Drawn {
  std::vector<Picture> pictures;
  double in_turns = 0.0;  ///< counter shadows.views_in_turns
  std::uint64_t shadow_bytes = 0;
  std::uint64_t bytes = 0;
};
/// together: one call of render draws all views of a frame; else each view has its call. From frame to frame a caster
/// moves, so that some maps stay as they are and others do not.
Drawn draw_many(const char* kept_atlases, std::uint32_t views, int frames, bool together) {
  gpu::Device& device = *test::drawing_device();
  Host host(device, make_all_modules());
  EXPECT_TRUE(host.renderer->knobs().set("shadows.kept_atlases", kept_atlases).ok());
  std::vector<ViewRequest> requests;
  for (std::uint32_t i = 0; i < views; ++i) requests.push_back(Host::view(i));
  for (int frame = 0; frame < frames; ++frame) {
    if (frame > 0) host.move_a_caster();
    if (together) host.draw(requests);
    for (const ViewRequest& request : requests)
      if (!together) host.draw({request});
  }
  Drawn drawn;
  for (const ViewRequest& request : requests)
    drawn.pictures.push_back(test::value_of(host.renderer->read_picture(request.settings.id)));
  drawn.shadow_bytes = bytes_of(device, "shadows");
  drawn.in_turns = host.renderer->report().counters.at("shadows.views_in_turns");
  drawn.bytes = device.memory_totals().used;
  for (const ViewRequest& request : requests) host.renderer->release_view(host.world, request.settings.id);
  host.renderer->release_world(host.world);
  host.renderer->free_idle_memory();
  EXPECT_EQ(device.memory_totals().used, 0u);
  EXPECT_EQ(device.memory_totals().reserved, 0u) << "empty blocks are given back";
  return drawn;
}

void expect_equal(const Drawn& a, const Drawn& b) {
  ASSERT_EQ(a.pictures.size(), b.pictures.size());
  for (std::size_t i = 0; i < a.pictures.size(); ++i) EXPECT_EQ(a.pictures[i].rgba, b.pictures[i].rgba) << "view " << i;
}

// Hard case: passes.release_view
TEST_F(ManyViews, sixty_take_little_memory_beside_one_atlas_and_show_what_each_shows_alone) {
  constexpr std::uint32_t kViews = 60;
  const Drawn own = draw_many("65536", kViews, 1, true), turns = draw_many("0", kViews, 1, true);
  expect_equal(own, turns);
  EXPECT_LT(turns.shadow_bytes, own.shadow_bytes / 8);
  EXPECT_EQ(own.in_turns, 0.0);
  EXPECT_EQ(turns.in_turns, kViews);
  EXPECT_LT(turns.bytes / kViews, std::uint64_t{1} << 20);
}

TEST_F(ManyViews, that_take_turns_follow_casters_that_move) {
  const Drawn own = draw_many("65536", 5, 3, true);
  expect_equal(own, draw_many("0", 5, 3, true));
  expect_equal(own, draw_many("0", 5, 3, false));
  expect_equal(own, draw_many("1", 5, 3, true));  // some views have their own
}

TEST_F(ManyViews, free_idle_memory_shrinks_an_atlas_that_past_frames_have_filled) {
  gpu::Device& device = *test::drawing_device();
  const auto draw = [](Host& host, std::uint32_t width) {
    ViewRequest request = Host::view(0);
    request.settings.width = width;
    request.settings.height = width / 2;
    host.draw({request});
  };
  std::uint64_t small = 0;
  Picture expected;
  {
    Host host(device, make_all_modules());
    draw(host, 32);
    draw(host, 32);
    ASSERT_TRUE(host.renderer->wait().ok());
    small = bytes_of(device, "shadows");
    expected = test::value_of(host.renderer->read_picture(ViewId{0}));
  }
  Host host(device, make_all_modules());
  draw(host, 512);
  draw(host, 32);
  ASSERT_TRUE(host.renderer->wait().ok());
  EXPECT_GT(bytes_of(device, "shadows"), 2 * small) << "the atlas is kept, in case the large picture returns";
  host.renderer->free_idle_memory();
  draw(host, 32);
  draw(host, 32);
  ASSERT_TRUE(host.renderer->wait().ok());  // the frames before may still use the large atlas
  EXPECT_LE(bytes_of(device, "shadows"), small * 5 / 4) << "lists keep a quarter more than they have needed";
  EXPECT_EQ(test::value_of(host.renderer->read_picture(ViewId{0})).rgba, expected.rgba);
  const FrameReport report = host.renderer->report();
  EXPECT_EQ(report.gpu_memory.used, device.memory_totals().used);
  EXPECT_GE(report.gpu_memory.reserved, report.gpu_memory.used);
  EXPECT_GT(report.counters.at("shadows.kept_bytes"), 0.0);
}

// Each view's maps go from its own images to those that it shares, and back, while all of them still exist.
TEST_F(ManyViews, that_get_their_own_atlas_again_do_not_show_what_it_held_before) {
  gpu::Device& device = *test::drawing_device();
  Host changes(device, make_all_modules()), stays(device, make_all_modules());
  const char* const kept_atlases[] = {"65536", "0", "65536", "0", "0", "65536"};
  std::uint32_t width = 32;
  for (const char* kept : kept_atlases) {
    ASSERT_TRUE(changes.renderer->knobs().set("shadows.kept_atlases", kept).ok());
    width = 288 - width;  // another size of the atlas
    for (std::uint32_t size : {width, 288 - width}) {
      std::vector<ViewRequest> requests = {Host::view(0), Host::view(3)};
      for (ViewRequest& request : requests) {
        request.settings.width = size;
        request.settings.height = size / 2;
      }
      for (Host* host : {&changes, &stays}) {
        host->move_a_caster();
        host->draw(requests);
      }
      for (const ViewRequest& request : requests)
        EXPECT_EQ(test::value_of(changes.renderer->read_picture(request.settings.id)).rgba,
                  test::value_of(stays.renderer->read_picture(request.settings.id)).rgba);
    }
  }
}

/// The modules that light and shadows need: each lifetime compiles its pipelines again.
ModuleList few_modules() {
  ModuleList modules = make_all_modules();
  std::erase_if(modules, [](const std::unique_ptr<Module>& module) {
    return module->name() != "lights" && module->name() != "shadows" && module->name() != "lighting";
  });
  return modules;
}

TEST_F(ManyViews, a_frame_beyond_the_budget_is_given_up_and_smaller_ones_go_on) {
  gpu::vulkan::Features features;
  gpu::HostDevice host_device = test::lend(*test::drawing_device(), features);
  host_device.memory.budget_bytes = std::uint64_t{64} << 20;
  const auto device = test::value_of(gpu::create_vulkan_device_on(host_device));
  Host host(*device, few_modules());
  ViewRequest request = Host::view(0);
  host.draw({request});
  const Picture before = test::value_of(host.renderer->read_picture(ViewId{0}));
  ViewRequest large = request;
  large.settings.width = 4096;
  large.settings.height = 2304;
  const Status refused = host.renderer->render(host.world, std::span(&large, 1));
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, ::testing::HasSubstr("MemoryOptions::budget_bytes is 67108864"));
  EXPECT_LE(device->memory_totals().reserved, host_device.memory.budget_bytes);
  host.draw({request});
  EXPECT_EQ(test::value_of(host.renderer->read_picture(ViewId{0})).rgba, before.rgba);
}

class Lifetimes : public ManyViews {};

// Hard case: passes.release_view
TEST_F(Lifetimes, twenty_devices_worlds_and_views_leave_nothing_behind) {
  test::CallWatch watch;
  const test::CountingCallbacks callbacks;
  gpu::vulkan::Features features;
  gpu::HostDevice host_device = test::lend(*test::drawing_device(), features);
  host_device.get_instance_proc_addr = test::CallWatch::loader();
  host_device.allocation_callbacks = callbacks.get();
  for (int lifetime = 1; lifetime <= 20; ++lifetime) {
    {
      const auto device = test::value_of(gpu::create_vulkan_device_on(host_device));
      Host host(*device, few_modules());
      // Fewer pipelines, which each lifetime compiles again.
      EXPECT_TRUE(host.renderer->knobs().set("shadows.mode", "monolithic").ok());
      std::vector<ViewRequest> requests;
      for (std::uint32_t i = 0; i < 3; ++i) requests.push_back(Host::view(i));
      host.draw(requests);
      EXPECT_GE(watch.live_bytes(), device->memory_totals().reserved);
      EXPECT_EQ(watch.live_bytes(), device->memory_totals().reserved) << "no memory is taken beside the blocks";
      host.renderer->release_view(host.world, ViewId{1});
      if (lifetime % 2 == 0) host.renderer->release_world(host.world);
    }
    EXPECT_EQ(watch.live_bytes(), 0u) << "lifetime " << lifetime;
    EXPECT_EQ(callbacks.live_bytes(), 0) << "lifetime " << lifetime;
  }
  EXPECT_GT(watch.most_bytes(), std::uint64_t{1} << 20);
  EXPECT_THAT(watch.without_callbacks(), ::testing::IsEmpty());
  EXPECT_THAT(watch.unknown(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace gloam
