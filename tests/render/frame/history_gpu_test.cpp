// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "engine/render/renderer.h"
#include "modules/lighting/module.h"
#include "modules/lights/module.h"
#include "tests/render/draws/small_scene.h"
#include "tests/render/frame/temporal_module.h"
#include "tests/support/gpu_device.h"

namespace gloam {
namespace {

struct Texel {
  float mean, frames, steps, one;
};

/// The noise of temporal.comp.glsl.
double noise(std::uint32_t x, std::uint32_t y, std::uint32_t frame) {
  const auto mixed = [](std::uint32_t v) {
    v = (v ^ (v >> 16)) * 0x7feb352du;
    v = (v ^ (v >> 15)) * 0x846ca68bu;
    return v ^ (v >> 16);
  };
  return (mixed(x + mixed(y + mixed(frame))) >> 8) / 16777216.0;
}

/// A renderer with a module that averages noise over frames, and one world.
class TemporalOnGpu : public ::testing::Test {
 protected:
  void SetUp() override {
    device_ = test::make_test_device();
    GLOAM_REQUIRE_GPU(device_);
    executor_ = make_pool_executor(1);
    RendererOptions options;
    options.device = device_.get();
    options.executor = executor_.get();
    options.log = &test::gpu_log();
    options.modules.push_back(make_lights_module());
    options.modules.push_back(make_lighting_module());
    options.modules.push_back(std::make_unique<test::TemporalModule>(control_));
    renderer_ = Renderer::create(std::move(options)).value();
    renderer_->prepare_world(world_);
  }
  void TearDown() override {
    renderer_.reset();
    if (!device_) return;
    EXPECT_EQ(device_->validation_messages(), 0u);
    for (const gpu::ModuleMemory& memory : device_->memory()) EXPECT_EQ(memory.bytes, 0u) << memory.module;
  }

  [[nodiscard]] static ViewRequest request(std::uint32_t id = 0, std::uint32_t width = 24) {
    ViewRequest request;
    request.settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), width, 20);
    request.settings.id = ViewId{id};
    return request;
  }
  void draw(const std::vector<ViewRequest>& views = {request()}) {
    const Status status = renderer_->render(world_, views);
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  void draw_frames(int count, const std::vector<ViewRequest>& views = {request()}) {
    for (int i = 0; i < count; ++i) draw(views);
  }
  void give_up(const std::vector<ViewRequest>& views = {request()}) {
    control_.fail = true;
    const Status status = renderer_->render(world_, views);
    control_.fail = false;
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "given up for the test");
  }
  [[nodiscard]] std::vector<Texel> texels(std::uint32_t view = 0) {
    const ImageBytes image = test::value_of(renderer_->read_image(world_, ViewId{view}, "mean"));
    width_ = image.width;
    std::vector<Texel> texels(image.bytes.size() / sizeof(Texel));
    std::memcpy(texels.data(), image.bytes.data(), image.bytes.size());
    return texels;
  }
  /// Compares the view's image with the means of the noise of the newest `frames` frames up to frame `last`.
  void expect_mean(std::uint32_t last, std::uint32_t frames, std::uint32_t view = 0) {
    const std::vector<Texel> found = texels(view);
    ASSERT_EQ(found.size() % width_, 0u);
    ASSERT_FALSE(found.empty());
    for (std::uint32_t i = 0; i < found.size(); ++i) {
      double sum = 0.0;
      for (std::uint32_t f = last + 1 - frames; f <= last; ++f) sum += noise(i % width_, i / width_, f);
      ASSERT_EQ(found[i].frames, static_cast<float>(frames)) << "texel " << i;
      ASSERT_NEAR(found[i].mean, sum / frames, 1e-5) << "texel " << i;
      ASSERT_EQ(found[i].steps, static_cast<float>(last + 1)) << "a world steps once in each of its frames";
    }
  }

  test::TemporalControl control_;
  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<JobExecutor> executor_;
  World world_;
  std::unique_ptr<Renderer> renderer_;
  std::uint32_t width_ = 0;
};

TEST_F(TemporalOnGpu, a_mean_over_frames_converges_on_the_means_of_noise) {
  const double deviation = std::sqrt(1.0 / 12.0);
  for (const int frames : {1, 63}) {
    draw_frames(frames);
    double squares = 0.0;
    const std::vector<Texel> found = texels();
    for (const Texel& texel : found) squares += (texel.mean - 0.5) * (texel.mean - 0.5);
    const double expected = deviation / std::sqrt(frames == 1 ? 1.0 : 64.0);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(found.size())), expected, 0.2 * expected);
  }
  expect_mean(63, 64);
}

// Hard case: passes.history_cut
TEST_F(TemporalOnGpu, a_camera_cut_restarts_the_mean) {
  draw_frames(3);
  ViewRequest cut = request();
  cut.settings.camera_cut = true;
  draw({cut});
  expect_mean(3, 1);
  draw_frames(2);
  expect_mean(5, 3);
  cut = request();
  cut.settings.camera.orthographic = true;
  draw_frames(2, {cut});
  expect_mean(7, 2);
}

// Hard case: passes.history_resize
TEST_F(TemporalOnGpu, a_resize_restarts_the_mean) {
  draw_frames(3);
  draw_frames(2, {request(0, 33)});
  EXPECT_EQ(control_.mean.age, 1u);
  expect_mean(4, 2);
  EXPECT_EQ(width_, 33u);
}

// Hard case: passes.history_given_up
TEST_F(TemporalOnGpu, a_frame_that_is_given_up_is_as_if_it_had_not_been) {
  draw_frames(3);
  give_up();
  give_up();
  draw_frames(2);
  expect_mean(4, 5);
  give_up({request(0, 33)});
  draw_frames(1);
  expect_mean(5, 6);
}

TEST_F(TemporalOnGpu, a_cut_that_was_given_up_restarts_in_the_next_frame) {
  draw_frames(3);
  ViewRequest cut = request();
  cut.settings.camera_cut = true;
  give_up({cut});
  draw_frames(2);
  expect_mean(4, 2);
}

TEST_F(TemporalOnGpu, reading_an_image_back_is_no_frame) {
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    draw();
    expect_mean(frame, frame + 1);
    expect_mean(frame, frame + 1);
  }
}

// Hard case: passes.history_gap
TEST_F(TemporalOnGpu, views_of_a_world_have_means_of_their_own_and_gaps_restart_them) {
  draw_frames(3, {request(0), request(1, 33)});
  expect_mean(2, 3, 0);
  expect_mean(2, 3, 1);
  draw_frames(3, {request(0)});
  draw({request(1, 33), request(0)});
  EXPECT_TRUE(control_.mean.valid());
  expect_mean(6, 1, 1);
  expect_mean(6, 7, 0);
}

}  // namespace
}  // namespace gloam
