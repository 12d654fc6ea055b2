// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Every call of Vulkan that can fail does, one in each life of a device, a world and its frames. The short form lets
// each function fail at a few of its places. With GLOAM_TEST_SCALE=2 every call fails, with 5 it is the short form with
// all modules, with 10 every call of all modules fails.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/render/draws/drawn_scene.h"
#include "tests/support/counted_memory.h"
#include "tests/support/failing_calls.h"
#include "tests/support/lent_device.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr int kFrames = 3;

bool has_every_module() { return test::scaled(1) >= 5; }
bool fails_every_call() { return has_every_module() ? test::scaled(1) >= 10 : test::scaled(1) > 1; }

/// What the host of a life has been told.
struct Life {
  std::vector<Error> errors;
  Picture picture;  ///< of the last frame; empty if that failed
};

class FailingCalls : public ::testing::Test {
 protected:
  void SetUp() override {
    owner_ = test::make_test_device();
    GLOAM_REQUIRE_GPU(owner_);
    GLOAM_REQUIRE_DEPTH_TESTS(owner_);
    host_ = test::lend(*owner_, features_);
    host_.get_instance_proc_addr = test::FailingCalls::loader();
    host_.allocation_callbacks = callbacks_.get();
    host_.log = nullptr;  // what is tolerated is logged
  }

  /// In the shorter forms those with few pipelines, which each life compiles again.
  static ModuleList modules() {
    ModuleList modules = make_all_modules();
    const auto is_left_out = [](const std::unique_ptr<Module>& module) {
      return module->name() != "lights" && module->name() != "lighting";
    };
    if (!has_every_module()) std::erase_if(modules, is_left_out);
    return modules;
  }
  static bool note(Life& life, const Status& status) {
    if (!status.ok()) life.errors.push_back(status.error());
    return status.ok();
  }
  /// Makes a device, a renderer and a world, draws frames and destroys all.
  Life live() {
    Life life;
    auto device = gpu::create_vulkan_device_on(host_);
    if (!device) {
      life.errors.push_back(device.error());
      return life;
    }
    RendererOptions options;
    options.device = device->get();
    options.executor = executor_.get();
    options.modules = modules();
    auto renderer = Renderer::create(std::move(options));
    if (!renderer) {
      life.errors.push_back(renderer.error());
      return life;
    }
    World world;
    (*renderer)->prepare_world(world);
    world.resource<SceneEnvironment>().has_exposure = true;
    test::fill_small_scene(world);
    static_cast<void>(test::add_lights(world));
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 32, 18);
    for (int frame = 0; frame < kFrames; ++frame) {
      world.resource<SceneClock>().time_s = frame / 60.0;
      const bool drawn = note(life, (*renderer)->render(world, {&request, 1}));
      if (frame + 1 < kFrames || !drawn) continue;
      auto picture = (*renderer)->read_picture(ViewId{0});
      if (picture) life.picture = std::move(*picture);
      if (!picture) life.errors.push_back(picture.error());
    }
    (*renderer)->release_world(world);
    return life;
  }
  void expect_nothing_is_left(const test::CallWatch& watch) const {
    EXPECT_EQ(watch.live_bytes(), 0u);
    EXPECT_EQ(callbacks_.live_bytes(), 0);
    EXPECT_EQ(owner_->validation_messages(), 0u);
  }
  static std::string words_of(VkResult result) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY) return "out of host memory";
    return result == VK_ERROR_OUT_OF_DEVICE_MEMORY ? "out of device memory" : "the device was lost";
  }
  void check(const Life& life, const Picture& undisturbed, VkResult result) const {
    for (const Error& error : life.errors) {
      EXPECT_FALSE(error.message.empty());
      EXPECT_THAT(error.message, ::testing::Not(::testing::HasSubstr("\n")));
    }
    if (result != VK_ERROR_DEVICE_LOST) {
      EXPECT_LE(life.errors.size(), 1u) << "the frames after the one that failed are drawn";
    }
    if (!life.errors.empty()) {
      EXPECT_THAT(life.errors.front().message, ::testing::HasSubstr(words_of(result)));
    }
    if (!life.picture.rgba.empty()) {
      EXPECT_EQ(life.picture.rgba, undisturbed.rgba);
    }
  }

  std::unique_ptr<gpu::Device> owner_;
  gpu::vulkan::Features features_;
  gpu::HostDevice host_;
  test::CountingCallbacks callbacks_;
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
};

/// The calls to fail: all of them, or some for each function.
std::vector<std::size_t> chosen_calls(const std::vector<test::FailingCalls::Call>& calls) {
  constexpr std::size_t kPlaces = 4;                            // of a function, in the short form
  std::map<std::string, std::vector<std::size_t>> by_function;  // the first call of each place
  std::set<std::pair<std::string, std::uint64_t>> places;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const bool is_new = places.emplace(calls[i].function, calls[i].place).second;
    if (is_new || fails_every_call()) by_function[calls[i].function].push_back(i);
  }
  std::vector<std::size_t> chosen;
  for (const auto& [function, indices] : by_function) {
    const std::size_t count = fails_every_call() ? indices.size() : std::min(indices.size(), kPlaces);
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(indices[i * indices.size() / count]);
  }
  return chosen;
}

// Hard case: passes.failing_call
TEST_F(FailingCalls, give_an_error_leave_nothing_behind_and_the_next_frames_are_right) {
  test::CallWatch watch;
  test::FailingCalls failing(test::CallWatch::loader());
  failing.begin();
  const Life undisturbed = live();
  ASSERT_TRUE(undisturbed.errors.empty()) << undisturbed.errors.front().message;
  expect_nothing_is_left(watch);
  const std::vector<test::FailingCalls::Call> calls = failing.calls();
  ASSERT_GT(calls.size(), 100u);
  std::size_t failed = 0;
  for (const std::size_t call : chosen_calls(calls)) {
    std::vector<VkResult> results = {call % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY};
    if (test::FailingCalls::can_lose_device(calls[call].function)) results.push_back(VK_ERROR_DEVICE_LOST);
    for (const VkResult result : results) {
      SCOPED_TRACE(calls[call].function + ", call " + std::to_string(call) + ": " + words_of(result));
      failing.begin(call, result);
      const Life life = live();
      failed += failing.has_failed() ? 1 : 0;
      check(life, undisturbed.picture, result);
      expect_nothing_is_left(watch);
      ASSERT_FALSE(HasFailure());
    }
  }
  EXPECT_GT(failed, 20u);
}

}  // namespace
}  // namespace gloam
