// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/render/renderer.h"
#include "engine/scene/resources.h"
#include "modules/fog/components.h"
#include "modules/module_list/module_list.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/frame/failing_module.h"
#include "tests/support/gpu_device.h"

namespace gloam {
namespace {

using test::FailAt;
using ::testing::HasSubstr;

constexpr std::uint32_t kFramesCompared = 4;

/// Results of two views: pictures, linear light, and the number of drawn shadow-map texels.
struct ShownViews {
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<std::vector<float>> light;
  std::vector<double> shadow_texels;
  bool operator==(const ShownViews&) const = default;
};

/// A place, and what the message must hold.
struct FailPlace {
  FailAt at = FailAt::nowhere;
  std::string name;
  std::string message;
};

void PrintTo(const FailPlace& place, std::ostream* out) { *out << place.name; }

const std::vector<FailPlace>& fail_places() {
  static const std::vector<FailPlace> all = {
      {FailAt::demand, "demand", "the frame failed: text of demand"},
      {FailAt::world_system, "world_system", "system 'fail_in_world' failed: text of world_system"},
      {FailAt::world_job, "world_job", "system 'fail_in_world' failed: text of a job"},
      {FailAt::view_system, "view_system", "system 'fail_in_view' failed: text of view_system"},
      {FailAt::prepare_view, "prepare_view", "the frame failed: text of prepare_view"},
      {FailAt::early_declaration, "early_declaration",
       "declaring the passes of module 'failing' failed: text of early_declaration"},
      {FailAt::late_declaration, "late_declaration",
       "declaring the passes of module 'failing' failed: text of late_declaration"},
      {FailAt::declaration_job, "declaration_job", "declaring the passes of module 'failing' failed: text of a job"},
      {FailAt::declaration_error, "declaration_error", "text of declaration_error"},
      {FailAt::recording, "recording", "pass 'may_fail' failed: text of recording"},
      {FailAt::recording_rendering, "recording_rendering", "pass 'may_fail' failed: text of recording_rendering"},
      {FailAt::recording_job, "recording_job", "pass 'may_fail' failed: text of a job"},
      {FailAt::recording_error, "recording_error", "pass 'may_fail' failed: text of recording_error"},
      {FailAt::foreign, "foreign", ""}};
  return all;
}

/// A renderer with all modules and the failing one, and a scene with cached shadows, a metered exposure and fog.
struct FailingSet {
  FailingSet(gpu::Device& device, JobExecutor& executor) {
    RendererOptions options;
    options.device = &device;
    options.executor = &executor;
    options.log = &test::gpu_log();
    options.modules = make_all_modules();
    options.modules.push_back(std::make_unique<test::FailingModule>());
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    test::fill_small_scene(world);
    test::add_lights(world);
    world.create(Fog{0.02f, vec3(0.4f, 0.5f, 0.6f)});
  }

  /// Moves the world to a frame: one box rises, the others rest.
  void step(std::uint32_t frame) {
    std::uint32_t index = 0;
    world.view<const MeshInstance, WorldTransform>().each([&](const MeshInstance&, WorldTransform& transform) {
      if (index++ == 1) transform.matrix[3].y = 0.1 * frame;
    });
    world.resource<SceneClock>().time_s = frame / 60.0;
  }
  [[nodiscard]] Status draw() {
    ViewRequest views[2];
    for (std::uint32_t v = 0; v < 2; ++v) {
      views[v].settings = test::look_at(v == 0 ? dvec3(2.0, 3.0, 9.0) : dvec3(-6.0, 2.0, 5.0), dvec3(0.0), 64, 40);
      views[v].settings.id = ViewId{v};
    }
    return renderer->render(world, views);
  }
  void draw_well(std::uint32_t frame) {
    step(frame);
    const Status drawn = draw();
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  }
  [[nodiscard]] ShownViews shown() {
    ShownViews shown;
    for (std::uint32_t v = 0; v < 2; ++v) {
      shown.pictures.push_back(test::value_of(renderer->read_picture(ViewId{v})).rgba);
      shown.light.push_back(test::value_of(renderer->read_linear(ViewId{v})).rgba);
    }
    for (const ViewCounters& view : renderer->report().views)
      shown.shadow_texels.push_back(view.counters.at("shadows.texels_drawn"));
    return shown;
  }

  World world;
  std::unique_ptr<Renderer> renderer;
};

/// Frames that are given up, on one device for all tests.
class GivenUp : public ::testing::TestWithParam<FailPlace> {
 protected:
  static void SetUpTestSuite() { device_ = test::make_test_device(); }
  static void TearDownTestSuite() {
    undisturbed_.clear();
    device_.reset();
  }
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device_);
    before_ = device_->validation_messages();
  }
  void TearDown() override {
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), before_);
    }
  }

  /// The results after frames 0 to `frame` if none is given up.
  static const ShownViews& undisturbed(std::uint32_t frame) {
    if (undisturbed_.empty()) {
      const auto executor = make_serial_executor();
      FailingSet set(*device_, *executor);
      for (std::uint32_t f = 0; f < kFramesCompared; ++f) {
        set.draw_well(f);
        undisturbed_.push_back(set.shown());
      }
    }
    return undisturbed_[frame];
  }

  /// Draws a frame that fails and checks what the caller is told.
  static void fail(FailingSet& set, const FailPlace& place, std::uint32_t view = ~0u) {
    std::uint32_t ended = 0;
    set.world.set_resource(test::Failure{place.at, view, &ended});
    if (place.at == FailAt::foreign) {
      EXPECT_THROW((void)set.draw(), int);
    } else {
      const Status drawn = set.draw();
      ASSERT_FALSE(drawn.ok());
      EXPECT_EQ(drawn.error().message, place.message);
      const bool is_input = place.name.ends_with("_error");
      EXPECT_EQ(drawn.error().kind, is_input ? ErrorKind::input : ErrorKind::failed);
    }
    if (place.name.ends_with("_job")) {
      EXPECT_GT(ended, 0u) << "jobs still ran when the exception left";
    }
    set.world.set_resource(test::Failure{});
  }

  static std::unique_ptr<gpu::Device> device_;
  static std::vector<ShownViews> undisturbed_;
  std::uint64_t before_ = 0;
};

std::unique_ptr<gpu::Device> GivenUp::device_;
std::vector<ShownViews> GivenUp::undisturbed_;

INSTANTIATE_TEST_SUITE_P(At, GivenUp, ::testing::ValuesIn(fail_places()),
                         [](const auto& param) { return param.param.name; });

// Hard case: passes.error_in_frame
TEST_P(GivenUp, the_next_frame_is_that_of_an_undisturbed_renderer) {
  for (const auto& executor : {make_serial_executor(), make_shuffled_executor(3), make_pool_executor(3)}) {
    FailingSet set(*device_, *executor);
    for (std::uint32_t frame = 0; frame < 3; ++frame) set.draw_well(frame);
    set.step(3);
    fail(set, GetParam());
    set.draw_well(3);
    EXPECT_TRUE(set.shown() == undisturbed(3));
  }
}

TEST_P(GivenUp, a_first_frame_leaves_no_trace) {
  const auto executor = make_pool_executor(2);
  FailingSet set(*device_, *executor);
  set.step(0);
  fail(set, GetParam());
  fail(set, GetParam());
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    set.draw_well(frame);
    EXPECT_TRUE(set.shown() == undisturbed(frame)) << "frame " << frame;
  }
}

TEST_P(GivenUp, frames_between_good_ones_leave_no_trace) {
  const auto executor = make_shuffled_executor(5);
  FailingSet set(*device_, *executor);
  for (std::uint32_t frame = 0; frame < kFramesCompared; ++frame) {
    set.step(frame);
    fail(set, GetParam(), frame % 2);  // in the first view, and in the second after the first was declared
    set.draw_well(frame);
    EXPECT_TRUE(set.shown() == undisturbed(frame)) << "frame " << frame;
  }
}

using GivenUpFrames = GivenUp;

TEST_F(GivenUpFrames, keep_the_picture_counters_and_memory_of_the_last_good_one) {
  const auto executor = make_pool_executor(2);
  FailingSet set(*device_, *executor);
  set.draw_well(0);
  const auto counters = set.renderer->report().counters;
  for (const FailPlace& place : fail_places()) {
    fail(set, place);
    EXPECT_TRUE(set.shown() == undisturbed(0)) << place.name;
    EXPECT_EQ(set.renderer->report().counters.at("engine.draws"), counters.at("engine.draws")) << place.name;
  }
  const auto bytes = [&] {
    EXPECT_TRUE(set.renderer->wait().ok());
    std::uint64_t sum = 0;
    for (const ModuleState& module : set.renderer->report().modules) sum += module.gpu_bytes;
    return sum;
  };
  set.draw_well(1);
  set.draw_well(2);
  const std::uint64_t after_a_round = bytes();
  for (int round = 0; round < 3; ++round)
    for (const FailPlace& place : fail_places()) fail(set, place);
  set.draw_well(1);
  set.draw_well(2);
  EXPECT_EQ(bytes(), after_a_round);
}

TEST_F(GivenUpFrames, of_a_view_that_was_never_drawn_have_no_picture) {
  const auto executor = make_serial_executor();
  FailingSet set(*device_, *executor);
  fail(set, fail_places().back());
  const auto picture = set.renderer->read_picture(ViewId{0});
  ASSERT_FALSE(picture.ok());
  EXPECT_THAT(picture.error().message, HasSubstr("given up"));
  EXPECT_FALSE(set.renderer->read_linear(ViewId{1}).ok());
}

TEST_F(GivenUpFrames, while_an_image_is_read_back_return_the_error_and_the_next_read_works) {
  const auto executor = make_serial_executor();
  FailingSet set(*device_, *executor);
  set.draw_well(0);
  const auto before = test::value_of(set.renderer->read_image(set.world, ViewId{0}, "depth")).bytes;
  set.world.set_resource(test::Failure{FailAt::recording_rendering});
  const auto refused = set.renderer->read_image(set.world, ViewId{0}, "depth");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("pass 'may_fail' failed"));
  set.world.set_resource(test::Failure{FailAt::foreign});
  EXPECT_THROW((void)set.renderer->read_image(set.world, ViewId{0}, "depth"), int);
  set.world.set_resource(test::Failure{});
  set.draw_well(0);
  EXPECT_TRUE(test::value_of(set.renderer->read_image(set.world, ViewId{0}, "depth")).bytes == before);
}

}  // namespace
}  // namespace gloam
