// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "engine/gpu/recording/device.h"
#include "modules/module_list/module_list.h"

namespace gloam {
namespace {

constexpr PanelFrame kFrame = {.width = 640, .height = 480, .dt_s = 0.02};

/// The panel over an empty scene, on the recording device. Any fault that the device finds fails the test.
class PlayPanelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto device = gpu::make_recording_device();
    device_ = device.get();
    session_.executor = make_shuffled_executor(1);
    session_.device = std::move(device);
    RendererOptions options;
    options.device = device_;
    options.executor = session_.executor.get();
    options.modules = make_all_modules();
    session_.renderer = Renderer::create(std::move(options)).value();
    session_.renderer->prepare_world(session_.world);
    settings_.width = kFrame.width;
    settings_.height = kFrame.height;
  }
  void TearDown() override { EXPECT_THAT(device_->faults(), ::testing::IsEmpty()); }

  /// Updates the panel and renders a frame under it.
  void frame(PlayPanel& panel, WindowInput& input, const PanelFrame& window = kFrame) {
    const Status updated = panel.update(input, window, settings_, scale_);
    ASSERT_TRUE(updated.ok()) << updated.error().message;
    ViewRequest request = {.settings = settings_, .target = {}};
    request.target.overlay = panel.overlay();
    const auto sample = session_.render_frame(request);
    ASSERT_TRUE(sample.ok()) << sample.error().message;
    passes_.clear();
    for (const PassTime& pass : sample->report.passes) passes_.insert(pass.name);
    if (passes_.contains("panel")) {
      const std::size_t copies = passes_.contains("results") ? 1 : 0;  // of what the GPU counted
      EXPECT_EQ(sample->report.passes.at(sample->report.passes.size() - 1 - copies).name, "panel")
          << "over everything else";
    }
  }
  void frame(PlayPanel& panel) {
    WindowInput input;
    frame(panel, input);
  }
  void toggle(PlayPanel& panel) {
    WindowInput input;
    input.toggle_panel = true;
    frame(panel, input);
  }

  Session session_;
  gpu::RecordingDevice* device_ = nullptr;
  ViewSettings settings_;
  ResolutionScale scale_{{80.0, 80.0}, 1.0};
  std::set<std::string> passes_;
};

TEST_F(PlayPanelTest, comes_and_goes_with_its_key) {
  PlayPanel panel(session_, 1.0, false);
  frame(panel);
  EXPECT_FALSE(passes_.contains("panel"));
  EXPECT_EQ(device_->pipeline_count("panel"), 0u) << "it costs nothing before it is shown";
  toggle(panel);
  EXPECT_TRUE(passes_.contains("panel"));
  frame(panel);
  EXPECT_TRUE(passes_.contains("panel"));
  toggle(panel);
  EXPECT_FALSE(passes_.contains("panel"));
}

TEST_F(PlayPanelTest, can_be_there_from_the_start) {
  PlayPanel panel(session_, 2.0, true);
  frame(panel);
  EXPECT_TRUE(passes_.contains("panel"));
}

TEST_F(PlayPanelTest, keeps_a_drag_on_it_from_the_camera) {
  PlayPanel panel(session_, 1.0, true);
  frame(panel);
  for (const bool over : {true, false}) {
    WindowInput input;
    input.forward = 1.0;
    input.drag_x = 5.0;
    input.panel.mouse_x = over ? 100.0 : 630.0;
    input.panel.mouse_y = 100.0;
    frame(panel, input);
    EXPECT_EQ(input.drag_x, over ? 0.0 : 5.0);
    EXPECT_EQ(input.forward, 1.0) << "keys are the camera's while no text is typed";
  }
}

TEST_F(PlayPanelTest, leaves_the_camera_alone_while_hidden) {
  PlayPanel panel(session_, 1.0, true);
  frame(panel);
  toggle(panel);
  WindowInput input;
  input.drag_x = 5.0;
  input.leave = true;
  input.panel.mouse_x = input.panel.mouse_y = 100.0;
  frame(panel, input);
  EXPECT_EQ(input.drag_x, 5.0);
  EXPECT_TRUE(input.leave);
}

TEST_F(PlayPanelTest, a_minimised_window_shows_none) {
  PlayPanel panel(session_, 1.0, true);
  WindowInput input;
  frame(panel, input, {.width = 0, .height = 0, .dt_s = 0.1});
  EXPECT_FALSE(passes_.contains("panel"));
}

}  // namespace
}  // namespace gloam
