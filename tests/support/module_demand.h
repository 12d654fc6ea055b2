// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/zones.h"
#include "engine/gpu/recording/device.h"
#include "engine/jobs/executor.h"
#include "engine/render/renderer.h"
#include "modules/module_list/module_list.h"
#include "tests/support/gpu_device.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

/// A renderer of all modules on a device that records commands, and the work of one module in its last frame.
class ModuleDemand : public testing::Test {
 protected:
  explicit ModuleDemand(std::string_view module) : module_(module) {
    RendererOptions options;
    options.device = device.get();
    options.executor = executor.get();
    options.log = &gpu_log();
    options.zones = &zones;
    options.modules = make_all_modules();
    renderer = Renderer::create(std::move(options)).value();
    renderer->prepare_world(world);
    scene = std::make_unique<SceneMaker>(world);
  }
  void TearDown() override {
    scene.reset();
    renderer.reset();
    EXPECT_THAT(device->faults(), testing::IsEmpty());
    EXPECT_THAT(device->memory(), testing::Each(testing::Field(&gpu::ModuleMemory::bytes, 0u)));
  }
  /// Draws frames, and notes the module's passes, systems and state in the last one.
  void frames(int count = 3) {
    for (int i = 0; i < count; ++i) {
      static_cast<void>(zones.take());
      const Status drawn = renderer->render(world, std::span(&request, 1));
      ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    }
    passes.clear();
    for (const PassTime& pass : renderer->report().passes)
      if (pass.module == module_) passes.insert(pass.name);
    systems.clear();
    for (const Zone& zone : zones.take())
      if (zone.module == module_) systems.insert(zone.name);
    for (const ModuleState& found : renderer->report().modules)
      if (found.name == module_) state = found;
  }
  /// The module did nothing in the last frame and owns nothing.
  void expect_nothing() {
    EXPECT_THAT(passes, testing::IsEmpty());
    EXPECT_THAT(systems, testing::IsEmpty());
    EXPECT_EQ(state.pipelines, 0u);
    EXPECT_EQ(state.gpu_bytes, 0u);
    EXPECT_FALSE(state.demanded) << state.reason;
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  ZoneRecorder zones;
  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  std::unique_ptr<Renderer> renderer;
  World world;
  std::unique_ptr<SceneMaker> scene;
  ViewRequest request;
  std::set<std::string> passes, systems;
  ModuleState state;

 private:
  std::string module_;
};

}  // namespace gloam::test
