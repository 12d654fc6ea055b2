// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/render/renderer.h"
#include "modules/fog/components.h"
#include "modules/fog/module.h"
#include "modules/lighting/module.h"
#include "modules/lights/module.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/modules_in_use/gated_device.h"
#include "tests/support/gpu_device.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFramesKept = 120;  // a module without demand keeps its memory for this many frames

/// A renderer with lights, lighting and fog, and its own world. The exposure is set, so that pictures depend only on
/// the frame's scene.
struct Set {
  Set(gpu::Device& device, JobExecutor& executor, Readiness readiness) {
    RendererOptions options;
    options.device = &device;
    options.executor = &executor;
    options.log = &test::gpu_log();
    options.readiness = readiness;
    options.modules.push_back(make_lights_module());
    options.modules.push_back(make_lighting_module());
    options.modules.push_back(make_fog_module());
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    test::fill_small_scene(world);
    world.resource<SceneEnvironment>().has_exposure = true;
    world.resource<SceneEnvironment>().exposure_ev100 = 3.0f;
  }

  void add_effects() {
    effects = test::add_lights(world);
    effects.push_back(world.create(Fog{0.05f, vec3(1.0f, 2.0f, 3.0f)}));
  }
  void remove_effects() {
    for (const Entity effect : effects) world.destroy(effect);
    effects.clear();
  }
  void frames(std::uint32_t count = 1) {
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 96, 64);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Status status = renderer->render(world, {&request, 1});
      ASSERT_TRUE(status.ok()) << status.error().message;
      drawn += 1;
    }
  }
  /// Number of passes of a module in the last frame. Waits until the frame has ended.
  [[nodiscard]] std::uint32_t passes(std::string_view module) {
    EXPECT_TRUE(renderer->wait().ok());
    std::uint32_t count = 0;
    for (const PassTime& pass : renderer->report().passes) count += pass.module == module ? 1 : 0;
    return count;
  }
  [[nodiscard]] std::size_t pending() const { return renderer->report().pipelines_pending; }
  [[nodiscard]] std::vector<std::uint8_t> picture() {
    return std::move(test::value_of(renderer->read_picture(ViewId{0})).rgba);
  }
  [[nodiscard]] std::vector<float> light() { return std::move(test::value_of(renderer->read_linear(ViewId{0})).rgba); }
  [[nodiscard]] ModuleState state_of(std::string_view module) {
    EXPECT_TRUE(renderer->wait().ok());
    for (const ModuleState& state : renderer->report().modules)
      if (state.name == module) return state;
    ADD_FAILURE() << "there is no module " << module;
    return {};
  }
  /// Bytes and pipelines of every module, as text.
  [[nodiscard]] std::string belongings() {
    EXPECT_TRUE(renderer->wait().ok());
    std::string text;
    for (const ModuleState& state : renderer->report().modules)
      text += state.name + " " + std::to_string(state.gpu_bytes) + " bytes, " + std::to_string(state.pipelines) +
              " pipelines\n";
    return text;
  }

  World world;
  std::vector<Entity> effects;
  std::unique_ptr<Renderer> renderer;
  std::uint32_t drawn = 0;
};

class DemandOnGpu : public ::testing::Test {
 protected:
  void SetUp() override {
    device_ = test::make_test_device();
    GLOAM_REQUIRE_GPU(device_);
    gate_ = std::make_unique<test::GatedDevice>(*device_);
    executor_ = make_serial_executor();  // a pipeline that a frame makes itself is made on this thread
  }
  void TearDown() override {
    if (gate_) gate_->open();  // a thread that waits at the gate would never end
    stage_.reset();
    if (device_) {
      EXPECT_EQ(device_->validation_messages(), 0u);
    }
  }
  Set& start(Readiness readiness) {
    stage_ = std::make_unique<Set>(*gate_, *executor_, readiness);
    return *stage_;
  }

  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<test::GatedDevice> gate_;
  std::unique_ptr<JobExecutor> executor_;
  std::unique_ptr<Set> stage_;
};

TEST_F(DemandOnGpu, effects_come_in_the_first_frame_and_go_without_a_trace) {
  Set& stage = start(Readiness::wait);
  stage.frames(3);
  const auto bare = stage.picture();
  for (const char* module : {"lights", "fog"}) {
    EXPECT_EQ(stage.passes(module), 0u);
    EXPECT_EQ(stage.state_of(module).gpu_bytes, 0u);
    EXPECT_EQ(stage.state_of(module).pipelines, 0u);
  }
  const std::string before = stage.belongings();
  stage.add_effects();
  stage.frames();
  EXPECT_EQ(stage.passes("lights"), 4u);  // uploads, texels and both searches
  EXPECT_EQ(stage.passes("fog"), 4u);
  EXPECT_GT(stage.state_of("lights").gpu_bytes, 0u);
  EXPECT_TRUE(stage.picture() != bare);
  stage.remove_effects();
  stage.frames();
  EXPECT_EQ(stage.passes("lights") + stage.passes("fog"), 0u);
  EXPECT_TRUE(stage.picture() == bare);
  stage.frames(kFramesKept);
  for (const char* module : {"lights", "fog"}) {
    EXPECT_EQ(stage.state_of(module).gpu_bytes, 0u);
    EXPECT_EQ(stage.state_of(module).pipelines, 0u);
  }
}

TEST_F(DemandOnGpu, a_hundred_toggles_grow_nothing) {
  Set& stage = start(Readiness::wait);
  std::string with, without;
  for (int toggle = 0; toggle < 100; ++toggle) {
    stage.add_effects();
    stage.frames();
    if (toggle == 4) with = stage.belongings();
    EXPECT_TRUE(toggle != 99 || stage.belongings() == with) << with << stage.belongings();
    stage.remove_effects();
    stage.frames();
    if (toggle == 4) without = stage.belongings();
    EXPECT_TRUE(toggle != 99 || stage.belongings() == without) << without << stage.belongings();
  }
}

TEST_F(DemandOnGpu, pictures_without_waiting_are_those_with_waiting_once_all_is_ready) {
  Set* stage = &start(Readiness::background);
  gate_->close();
  stage->frames();
  const auto bare = stage->picture();
  stage->add_effects();
  stage->frames(3);
  ASSERT_TRUE(gate_->wait_for_one_at_the_gate());
  EXPECT_EQ(stage->passes("lights") + stage->passes("fog"), 0u);
  EXPECT_TRUE(stage->picture() == bare) << "until it is ready the picture is that of a scene without it";
  gate_->open();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(25);
  while (stage->passes("lights") == 0 || stage->passes("fog") == 0 || stage->pending() > 0) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stage->frames();
  }
  stage->frames();  // with the last pipelines
  EXPECT_EQ(gate_->asked_here("lights") + gate_->asked_here("fog"), 0u);
  const auto picture = stage->picture();
  const auto light = stage->light();
  const std::uint32_t drawn = stage->drawn;
  EXPECT_TRUE(picture != bare);

  stage = &start(Readiness::wait);
  stage->add_effects();
  stage->frames(drawn);
  EXPECT_TRUE(stage->picture() == picture);
  EXPECT_TRUE(stage->light() == light);
}

}  // namespace
}  // namespace gloam
