// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui/imgui.h>

#include <memory>
#include <string>

#include "engine/gpu/recording/device.h"
#include "tests/sandbox/window/small_knobs.h"

namespace gloam {
namespace {

/// Draws a panel on the recording device. Any fault that the device finds fails the test.
class PanelRendererTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto renderer = PanelRenderer::create(*device_, panel_.font());
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    renderer_ = std::move(renderer).value();
  }
  void TearDown() override {
    renderer_.reset();
    EXPECT_THAT(device_->faults(), ::testing::IsEmpty());
  }

  void lay_out(std::uint32_t width, std::uint32_t height) {
    const PanelContent content = {.knobs = knobs_,
                                  .times = times_,
                                  .modules = {},
                                  .visualizers = {},
                                  .visualizer = "none",
                                  .show = [](const std::string&) { return Status(); }};
    panel_.update({}, {.width = width, .height = height, .dt_s = 0.02}, content);
  }

  void draw(std::uint32_t width, std::uint32_t height, gpu::Format format = gpu::Format::bgra8_unorm) {
    const auto image = device_->create_image({.name = "picture",
                                              .module = "test",
                                              .format = format,
                                              .width = width,
                                              .height = height,
                                              .usage = gpu::ImageUsage::color_target});
    ASSERT_TRUE(image.ok());
    device_->forget_commands();
    auto commands = device_->begin_frame();
    ASSERT_TRUE(commands.ok());
    graph_.begin();
    const ImageRef before = graph_.import_image("picture", *image, gpu::Access::none, gpu::Access::color_target);
    ImageRef picture = before;
    ASSERT_TRUE(renderer_->add_pass(graph_, picture, panel_.draw_data()).ok());
    EXPECT_GT(picture.version, before.version);
    ASSERT_TRUE(graph_.compile().ok());
    graph_.execute(**commands);
    ASSERT_TRUE(device_->submit_frame().ok());
    device_->destroy(*image);
  }

  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const {
    std::vector<std::string> found;
    for (const gpu::RecordedCommand& command : device_->commands())
      if (command.name == name) found.push_back(command.text);
    return found;
  }

  std::unique_ptr<gpu::RecordingDevice> device_ = gpu::make_recording_device();
  FrameGraph graph_{*device_};
  KnobRegistry knobs_ = test::small_knobs();
  FrameTimes times_;
  Panel panel_;
  std::unique_ptr<PanelRenderer> renderer_;
};

TEST_F(PanelRendererTest, draws_in_one_pass_frame_after_frame) {
  for (int i = 0; i < 4; ++i) {
    lay_out(640, 480);
    draw(640, 480);
    EXPECT_EQ(texts("begin_rendering").size(), 1u);
    EXPECT_GT(texts("draw_indexed").size(), 0u);
    EXPECT_EQ(texts("set_scissor").size(), texts("draw_indexed").size());
  }
  EXPECT_EQ(device_->pipeline_count("panel"), 1u);
}

TEST_F(PanelRendererTest, a_picture_of_another_size_or_format_than_planned_is_drawn_too) {
  lay_out(640, 480);
  draw(320, 100);
  draw(640, 480, gpu::Format::rgba8_srgb);
  EXPECT_EQ(device_->pipeline_count("panel"), 2u);
}

TEST_F(PanelRendererTest, leaves_nothing_behind) {
  lay_out(640, 480);
  draw(640, 480);
  renderer_.reset();
  for (const gpu::ModuleMemory& memory : device_->memory()) EXPECT_EQ(memory.bytes, 0u) << memory.module;
  EXPECT_EQ(device_->pipeline_count("panel"), 0u);
}

TEST_F(PanelRendererTest, tells_when_there_is_no_memory) {
  device_->fail_next_creation({ErrorKind::failed, "out of memory"});
  EXPECT_FALSE(PanelRenderer::create(*device_, panel_.font()).ok());
}

}  // namespace
}  // namespace gloam
