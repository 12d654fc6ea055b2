// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "engine/gpu/recording/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "modules/module_list/module_list.h"
#include "tests/modules/grass/support/grass_stage.h"
#include "tests/render/modules_in_use/gated_device.h"
#include "tests/support/gltf_files.h"

namespace gloam::test {
namespace {

/// Properties of a view and its world that select the pipelines for its blades.
struct ViewKind {
  const char* name;
  bool motion, mirrored;
  bool textured = false;
};

class GrassReadiness : public testing::TestWithParam<ViewKind> {
 protected:
  void SetUp() override {
    RendererOptions options;
    options.device = &gate;
    options.executor = executor.get();
    options.log = &gpu_log();
    options.readiness = Readiness::background;
    options.modules = make_all_modules();
    options.modules.push_back(std::make_unique<GuestModule>(no_passes, GetParam().motion));
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    SceneMaker scene(world);
    GrassSurface values;
    values.density = 100.0f;
    const std::vector<std::uint8_t> leaf = make_png(2, 16, std::array<std::uint8_t, 4>{0, 255, 0, 255});
    if (GetParam().textured) values.texture = world.resource<SceneStrings>().intern(folder.write("leaf.png", leaf));
    world.add(scene.draw(scene.mesh(quad(1.0f)), GrassStage::lying(dvec3(0.0))), values);
    request.settings = look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0), 64, 48);
    if (GetParam().mirrored) request.settings.mirror = MirrorPlane{dvec3(0.0, 0.0, 1.0), -0.8};
  }
  void TearDown() override {
    gate.open();
    renderer.reset();
    EXPECT_THAT(device->faults(), testing::IsEmpty());
  }
  /// Draws a frame. Returns whether it draws blades.
  [[nodiscard]] bool frame() {
    const Status drawn = renderer->render(world, std::span(&request, 1));
    EXPECT_TRUE(drawn.ok()) << drawn.error().message;
    const FrameReport report = renderer->report();
    return std::ranges::any_of(report.passes, [](const PassTime& pass) { return pass.name == "grass_blades"; });
  }

  GuestModule::Passes no_passes = [](FrameBuilder&, PassPhase) {};
  /// The gate stops other threads, also where they would make a pipeline that the frame waits for.
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  GatedDevice gate{*device};
  std::unique_ptr<Renderer> renderer;
  World world;
  ViewRequest request;
  TemporaryFolder folder;
};

TEST_P(GrassReadiness, blades_come_when_their_pipelines_are_made_and_no_frame_makes_one) {
  gate.close();
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(frame());
  gate.open();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!frame()) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the blades never came";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame());
  EXPECT_EQ(gate.asked_here("grass"), 0u);
}

INSTANTIATE_TEST_SUITE_P(Views, GrassReadiness,
                         testing::Values(ViewKind{"still", false, false}, ViewKind{"motion", true, false},
                                         ViewKind{"mirrored", false, true}, ViewKind{"mirrored_motion", true, true},
                                         ViewKind{"textured", false, false, true},
                                         ViewKind{"textured_motion", true, true, true}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace gloam::test
