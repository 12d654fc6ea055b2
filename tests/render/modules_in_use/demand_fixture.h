// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/core/zones.h"
#include "engine/gpu/recording/device.h"
#include "engine/render/renderer.h"
#include "modules/fog/components.h"
#include "modules/fog/module.h"
#include "modules/lighting/module.h"
#include "modules/lights/module.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/module.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/modules_in_use/counting_module.h"
#include "tests/render/modules_in_use/gated_device.h"

namespace gloam::test {

inline constexpr std::uint32_t kFramesKept = 120;  ///< a module without demand keeps its memory for this many frames
inline const std::vector<std::string> kOptionalModules = {"lights", "fog", "counting"};

/// A log that keeps its lines.
class LineLog final : public LogSink {
 public:
  void write(LogLevel, std::string_view line) override {
    const std::lock_guard lock(mutex_);
    lines_.emplace_back(line);
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

/// One module's work in the last frame, and the resources that it owns.
struct Seen {
  std::uint32_t passes = 0;
  std::uint32_t dispatches = 0;
  std::uint32_t draws = 0;
  std::uint32_t pipelines = 0;
  std::uint64_t bytes = 0;
  std::set<std::string> systems;  ///< systems that ran
};

/// A renderer with lights, lighting, fog and a counting module on a gated recording device, and a small scene without
/// lights or fog. Faults that the recording device finds fail the test.
class DemandTest : public ::testing::Test {
 protected:
  DemandTest() { make_renderer(Readiness::wait); }

  void make_renderer(Readiness readiness) {
    renderer_.reset();
    world_ = std::make_unique<World>();
    device_ = gpu::make_recording_device();
    gate_ = std::make_unique<GatedDevice>(*device_);
    RendererOptions options;
    options.device = gate_.get();
    options.executor = executor_.get();
    options.log = &log_;
    options.zones = &zones_;
    options.readiness = readiness;
    options.modules = every_module_ ? make_all_modules() : make_modules();
    renderer_ = Renderer::create(std::move(options)).value();
    renderer_->prepare_world(*world_);
    fill_small_scene(*world_);
  }

  [[nodiscard]] ModuleList make_modules() {
    ModuleList modules;
    modules.push_back(make_lights_module());
    if (with_shadows_) modules.push_back(make_shadows_module());
    modules.push_back(make_lighting_module());
    modules.push_back(make_fog_module());
    modules.push_back(std::make_unique<CountingModule>(calls_));
    return modules;
  }

  void TearDown() override {
    gate_->open();  // a thread that waits at the gate would never end
    renderer_.reset();
    EXPECT_THAT(device_->faults(), ::testing::IsEmpty());
    EXPECT_THAT(device_->memory(), ::testing::Each(::testing::Field(&gpu::ModuleMemory::bytes, 0u)));
  }

  [[nodiscard]] static ViewRequest request(std::uint32_t id = 0) {
    ViewRequest request;
    request.settings = look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 64, 40);
    request.settings.id = ViewId{id};
    return request;
  }
  [[nodiscard]] Status render(World& world, const std::vector<ViewRequest>& views) {
    device_->forget_commands();
    Status status = renderer_->render(world, views);
    systems_.clear();
    for (Zone& zone : zones_.take()) systems_[zone.module].insert(std::move(zone.name));
    return status;
  }
  void frames(std::uint32_t count = 1, const std::vector<ViewRequest>& views = {request()}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const Status status = render(*world_, views);
      ASSERT_TRUE(status.ok()) << status.error().message;
    }
  }
  /// Renders until the cached plans of the first frames, which have other passes, have freed their memory.
  void settle() { frames(70); }
  /// Renders until `name` has passes. With Readiness::background this takes an unknown number of frames.
  void frames_until_there_are_passes_of(std::string_view name) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (seen(name).passes == 0) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << name << " never came";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      frames();
    }
  }

  /// Renders until no pipeline is pending in the background. A module may have passes while pipelines of other modules
  /// that depend on it are still pending.
  void frames_until_nothing_is_pending() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (renderer_->report().pipelines_pending > 0) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "pipelines are pending for ever";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      frames();
    }
  }

  [[nodiscard]] Seen seen(std::string_view name) {
    Seen seen;
    const FrameReport report = renderer_->report();
    for (const PassTime& pass : report.passes) {
      if (pass.module != name) continue;
      ++seen.passes;
      seen.dispatches += pass.dispatches;
      seen.draws += pass.draws;
    }
    for (const ModuleState& state : report.modules) {
      if (state.name != name) continue;
      seen.pipelines = state.pipelines;
      seen.bytes = state.gpu_bytes;
    }
    seen.systems = systems_[std::string(name)];
    return seen;
  }
  /// Number of dispatch and draw commands of the last frame, by name.
  [[nodiscard]] std::map<std::string, std::uint32_t> work() const {
    std::map<std::string, std::uint32_t> work;
    for (const gpu::RecordedCommand& command : device_->commands())
      if (command.name.starts_with("dispatch") || command.name.starts_with("draw")) ++work[command.name];
    return work;
  }
  /// Bytes and pipelines of every module, as text.
  [[nodiscard]] std::string belongings() {
    std::string text;
    for (const ModuleState& state : renderer_->report().modules)
      text += state.name + " " + std::to_string(state.gpu_bytes) + " bytes, " + std::to_string(state.pipelines) +
              " pipelines\n";
    return text;
  }

  /// Adds an entity that makes the scene demand a module.
  Entity call_for(std::string_view name) {
    if (name == "fog") return world_->create(Fog{0.05f, vec3(1.0f, 2.0f, 3.0f)});
    if (name == "counting") return world_->create(Counted{});
    Light lamp;
    lamp.intensity = 100.0f;
    lamp.range_m = 5.0f;
    return world_->create(WorldTransform{in_view()}, lamp);
  }
  /// Transforms at which a light of call_for reaches into the view, and at which it does not.
  [[nodiscard]] static dmat4 in_view() { return glm::translate(dmat4(1.0), dvec3(1.0, 3.0, 3.0)); }
  [[nodiscard]] static dmat4 out_of_view() { return glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 1000.0)); }
  void show(std::string_view name, Entity entity, bool visible) {
    if (name == "lights") world_->get<WorldTransform>(entity).matrix = visible ? in_view() : out_of_view();
    if (name == "counting") world_->get<Counted>(entity).in_view = visible;
  }

  bool every_module_ = false;  ///< whether the next renderer has make_all_modules() and nothing else
  bool with_shadows_ = false;  ///< whether the next renderer has the shadows module
  CountedCalls calls_;
  LineLog log_;
  ZoneRecorder zones_;
  std::map<std::string, std::set<std::string>> systems_;  ///< systems that ran in the last frame, by module
  std::unique_ptr<JobExecutor> executor_ = make_shuffled_executor(3);
  std::unique_ptr<gpu::RecordingDevice> device_;
  std::unique_ptr<GatedDevice> gate_;
  std::unique_ptr<World> world_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace gloam::test
