// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Histories in whole frames of a renderer on a recording device.
#include "engine/frame/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "engine/render/renderer.h"
#include "modules/lighting/module.h"
#include "modules/lights/module.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/frame/temporal_module.h"
#include "tests/render/modules_in_use/gated_device.h"

namespace gloam {
namespace {

constexpr std::uint64_t kMeanBytes = 2 * 16 * 16 * 16;  // two images of 16×16 texels of 16 bytes

/// A device whose submissions can fail.
class FailingDevice final : public test::GatedDevice {
 public:
  using GatedDevice::GatedDevice;
  bool fail = false;
  [[nodiscard]] Status submit_frame() override {
    const Status status = GatedDevice::submit_frame();
    if (fail) return Error{ErrorKind::failed, "the device is lost"};
    return status;
  }
};

class HistoryFrames : public ::testing::Test {
 protected:
  HistoryFrames() {
    RendererOptions options;
    options.device = &failing_;
    options.executor = executor_.get();
    options.modules.push_back(make_lights_module());
    options.modules.push_back(make_lighting_module());
    options.modules.push_back(std::make_unique<test::TemporalModule>(control_));
    renderer_ = Renderer::create(std::move(options)).value();
    renderer_->prepare_world(world_);
    renderer_->prepare_world(other_);
  }
  void TearDown() override {
    renderer_.reset();
    EXPECT_THAT(device_->faults(), ::testing::IsEmpty());
    EXPECT_THAT(device_->memory(), ::testing::Each(::testing::Field(&gpu::ModuleMemory::bytes, 0u)));
  }

  [[nodiscard]] static ViewRequest request(std::uint32_t id = 0) {
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), 16, 16);
    request.settings.id = ViewId{id};
    return request;
  }
  void draw(World& world, std::uint32_t view = 0) {
    const ViewRequest one = request(view);
    const Status status = renderer_->render(world, {&one, 1});
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  void draw(std::uint32_t view = 0) { draw(world_, view); }
  [[nodiscard]] std::uint64_t bytes(std::string_view module = "temporal") const {
    for (const gpu::ModuleMemory& memory : device_->memory())
      if (memory.module == module) return memory.bytes;
    return 0;
  }

  test::TemporalControl control_;
  std::unique_ptr<JobExecutor> executor_ = make_shuffled_executor(3);
  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  FailingDevice failing_{*device_};
  World world_;
  World other_;
  std::unique_ptr<Renderer> renderer_;
};

TEST_F(HistoryFrames, a_failed_submission_gives_the_frame_up) {
  draw();
  draw();
  failing_.fail = true;
  const ViewRequest one = request();
  for (int i = 0; i < 3; ++i) {
    const Status status = renderer_->render(world_, {&one, 1});
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "the device is lost");
  }
  failing_.fail = false;
  draw();
  EXPECT_TRUE(control_.mean.valid());
  EXPECT_EQ(control_.mean.age, 1u);
  EXPECT_EQ(control_.view.frame, 2u);
  EXPECT_EQ(control_.commits, 3u);
}

TEST_F(HistoryFrames, what_a_view_keeps_is_counted) {
  draw(0);
  const double one = renderer_->report().counters.at("temporal.kept_bytes");
  EXPECT_GT(one, 0.0);
  EXPECT_LE(one, static_cast<double>(bytes()));
  draw(1);
  EXPECT_EQ(renderer_->report().counters.at("temporal.kept_bytes"), one) << "of the last view only";
  renderer_->release_view(ViewId{1});
  EXPECT_EQ(renderer_->report().counters.count("temporal.kept_bytes"), 0u);
}

TEST_F(HistoryFrames, a_declaration_that_fails_gives_the_frame_up) {
  draw();
  control_.fail = true;
  const ViewRequest one = request();
  EXPECT_FALSE(renderer_->render(world_, {&one, 1}).ok());
  control_.fail = false;
  draw();
  EXPECT_EQ(control_.mean.age, 1u);
  EXPECT_EQ(control_.view.frame, 1u);
  EXPECT_EQ(control_.commits, 2u);
}

TEST_F(HistoryFrames, worlds_have_frames_and_histories_of_their_own) {
  draw(world_);
  draw(world_);
  draw(other_);
  EXPECT_EQ(control_.mean.reset, HistoryReset::created);
  EXPECT_EQ(control_.view.frame, 0u);
  draw(world_);
  EXPECT_TRUE(control_.mean.valid());
  EXPECT_EQ(control_.mean.age, 1u);
  EXPECT_EQ(control_.view.frame, 2u);
  EXPECT_FALSE(control_.view.camera_cut());
}

TEST_F(HistoryFrames, a_released_view_or_world_begins_anew) {
  draw(0);
  draw(1);
  ASSERT_EQ(bytes(), 2 * kMeanBytes + 4);
  renderer_->release_view(ViewId{1});
  EXPECT_EQ(bytes(), kMeanBytes + 4);
  draw(1);
  EXPECT_EQ(control_.mean.reset, HistoryReset::created);
  EXPECT_TRUE(control_.view.camera_cut());
  EXPECT_TRUE(control_.steps.valid()) << "the world's own stays";
  renderer_->release_world(world_);
  EXPECT_EQ(bytes(), 0u);
  draw();
  EXPECT_EQ(control_.mean.reset, HistoryReset::created);
  EXPECT_FALSE(control_.steps.valid());
}

TEST_F(HistoryFrames, a_module_without_demand_loses_its_history_with_its_memory) {
  draw();
  control_.demanded = false;
  for (int i = 0; i < 119; ++i) draw();
  EXPECT_EQ(bytes(), kMeanBytes + 4);
  draw();
  EXPECT_EQ(bytes(), 0u);
}

TEST_F(HistoryFrames, a_view_that_is_not_drawn_loses_its_history_after_a_while) {
  draw(1);
  for (int i = 0; i < 121; ++i) draw(0);
  EXPECT_EQ(bytes(), kMeanBytes + 4);
}

TEST_F(HistoryFrames, reading_back_neither_counts_nor_ages) {
  draw(1);
  draw(0);
  for (std::uint64_t i = 0; i < 2 * History::kFramesKept; ++i) {
    ASSERT_TRUE(renderer_->read_image(world_, ViewId{0}, "mean").ok());
    ASSERT_EQ(control_.mean.reset, HistoryReset::created);
    ASSERT_TRUE(control_.mean.written);
  }
  EXPECT_EQ(bytes(), 2 * kMeanBytes + 4);
  draw(0);
  EXPECT_EQ(control_.mean.age, 1u);
  EXPECT_EQ(control_.view.frame, 2u);
}

TEST_F(HistoryFrames, an_exposure_is_metered_once_for_each_camera) {
  const auto metered = [&](Entity camera) {
    ViewRequest one = request();
    one.settings.camera_entity = camera;
    const Status status = renderer_->render(world_, {&one, 1});
    EXPECT_TRUE(status.ok());
    for (const PassTime& pass : renderer_->report().passes)
      if (pass.name == "meter") return true;
    return false;
  };
  const Entity first = world_.create(), second = world_.create();
  EXPECT_TRUE(metered(first));
  EXPECT_FALSE(metered(first));
  EXPECT_TRUE(metered(second));
  EXPECT_FALSE(metered(first));
  EXPECT_FALSE(metered(second));
  EXPECT_EQ(bytes("lighting"), 16u) << "eight for each camera";
}

TEST_F(HistoryFrames, an_exposure_that_was_metered_in_a_frame_given_up_is_metered_again) {
  const ViewRequest one = request();
  control_.fail = true;
  EXPECT_FALSE(renderer_->render(world_, {&one, 1}).ok());
  control_.fail = false;
  draw();
  std::vector<std::string> passes;
  for (const PassTime& pass : renderer_->report().passes) passes.push_back(pass.name);
  EXPECT_THAT(passes, ::testing::Contains("meter"));
}

}  // namespace
}  // namespace gloam
