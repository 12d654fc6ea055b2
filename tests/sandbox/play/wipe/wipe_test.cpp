// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/wipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tests/sandbox/play/budget/empty_session.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The wipe over an empty scene, on the recording device. Any fault that the device finds fails the test.
class WipeTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(session_->renderer->set_budget({.ms = 11.0, .front = test::session_points()}).ok());
    view_.width = 64;
    view_.height = 36;
    wipe_ = std::make_unique<Wipe>(*session_);
  }
  void TearDown() override {
    wipe_.reset();
    EXPECT_THAT(device_->faults(), IsEmpty());
  }

  /// Draws a frame of the picture now, with the exact one if it is due. Returns the exact view's settings.
  std::optional<ViewSettings> frame(double time_s = 0.0) {
    const auto exact = wipe_->due(view_, time_s, 1.0, 0.1);
    EXPECT_TRUE(exact.ok());
    ViewRequest now = {.settings = view_, .target = {}};
    now.target.overlay = [this](FrameGraph& graph, ImageRef& picture) { return wipe_->add_pass(graph, picture); };
    std::vector<ViewRequest> requests = {now};
    if (*exact) requests.insert(requests.begin(), **exact);
    const Status drawn = session_->renderer->render(session_->world, requests);
    EXPECT_TRUE(drawn.ok()) << drawn.error().message;
    EXPECT_TRUE(session_->renderer->wait().ok());
    passes_.clear();
    for (const PassTime& pass : session_->renderer->report().passes) passes_.insert(pass.name);
    if (!*exact) return std::nullopt;
    wipe_->drawn();
    return (*exact)->settings;
  }

  gpu::RecordingDevice* device_ = nullptr;
  std::unique_ptr<Session> session_ = test::empty_session(device_);
  std::unique_ptr<Wipe> wipe_;
  ViewSettings view_;
  std::set<std::string> passes_;
};

TEST_F(WipeTest, draws_the_exact_picture_beside_the_picture_now) {
  EXPECT_FALSE(frame()) << "it is off";
  wipe_->set({.on = true});
  EXPECT_THAT(wipe_->shown().note, HasSubstr("being drawn"));
  const std::uint64_t version = session_->renderer->knobs().version();
  static_cast<void>(frame());
  for (std::uint32_t i = 0; i < SideTiming::kFrames; ++i) {
    const auto exact = frame();
    ASSERT_TRUE(exact);
    EXPECT_NE(exact->id, view_.id) << "a view with histories of its own";
    EXPECT_EQ(exact->camera_cut, i == 0);
    EXPECT_EQ(exact->width, 64u) << "views.scale is 1 in the most exact setting";
    EXPECT_EQ(exact->knobs.size(), 2u);
    EXPECT_FALSE(passes_.contains("wipe"));
  }
  EXPECT_FALSE(frame());
  EXPECT_TRUE(passes_.contains("wipe"));
  EXPECT_THAT(wipe_->shown().note, IsEmpty());
  EXPECT_EQ(session_->renderer->knobs().version(), version);
  EXPECT_EQ(test::knob_text(session_->renderer->knobs(), "shadows.filter"), "hard");
  EXPECT_EQ(session_->renderer->budget()->point, 0u);
}

TEST_F(WipeTest, a_locked_scale_is_the_exact_picture_s_too) {
  ASSERT_TRUE(session_->renderer->change_budget("", 11.0, {"views.scale"}).ok());
  wipe_->set({.on = true});
  static_cast<void>(frame());
  for (std::uint32_t i = 0; i < SideTiming::kFrames; ++i) {
    const auto exact = wipe_->due(view_, 0.0, 0.5, 0.1);
    ASSERT_TRUE(exact.ok() && *exact);
    EXPECT_EQ((*exact)->settings.width, 32u);
    const std::array requests = {**exact, ViewRequest{.settings = view_, .target = {}}};
    ASSERT_TRUE(session_->renderer->render(session_->world, requests).ok());
    wipe_->drawn();
  }
  static_cast<void>(frame());
  EXPECT_TRUE(passes_.contains("wipe")) << "the picture was enlarged to the window";
}

TEST_F(WipeTest, frames_with_the_exact_picture_and_those_under_way_are_not_judged) {
  wipe_->set({.on = true});
  EXPECT_TRUE(wipe_->judges_frame());
  static_cast<void>(frame());
  EXPECT_TRUE(wipe_->judges_frame());
  ASSERT_TRUE(frame());
  for (std::uint32_t i = 0; i <= gpu::Device::kFramesInFlight; ++i) EXPECT_FALSE(wipe_->judges_frame());
  EXPECT_TRUE(wipe_->judges_frame());
}

TEST_F(WipeTest, another_moment_or_size_waits_for_another_picture) {
  wipe_->set({.on = true});
  for (int i = 0; i < 5; ++i) static_cast<void>(frame());
  ASSERT_TRUE(passes_.contains("wipe"));
  EXPECT_FALSE(frame(1.0));
  EXPECT_TRUE(passes_.contains("wipe")) << "the last picture is shown meanwhile";
  EXPECT_THAT(wipe_->shown().note, HasSubstr("earlier moment"));
  view_.width = 80;
  EXPECT_FALSE(frame(1.0));
  EXPECT_FALSE(passes_.contains("wipe")) << "it does not fit";
  for (int i = 0; i < 10; ++i) static_cast<void>(frame(1.0));
  EXPECT_TRUE(passes_.contains("wipe"));
  EXPECT_THAT(wipe_->shown().note, IsEmpty());
}

TEST_F(WipeTest, kept_settings_are_drawn_in_each_frame_that_changes) {
  KnobRegistry& knobs = session_->renderer->knobs();
  std::vector<KnobOverride> kept;
  for (const Knob& knob : knobs.knobs()) kept.push_back({knob.name, knobs.text(knob)});
  const auto filter = std::ranges::find(kept, "shadows.filter", &KnobOverride::name);
  ASSERT_NE(filter, kept.end());
  filter->value = "pcf";
  wipe_->set({.on = true, .side = WipeSide::kept_b, .kept = kept});
  for (int time = 0; time < 6; ++time) {
    const auto right = frame(time);
    ASSERT_TRUE(right) << time;
    ASSERT_EQ(right->knobs.size(), 1u) << "what B has as it is now is no override";
    EXPECT_EQ(right->knobs[0].name, "shadows.filter");
    EXPECT_EQ(right->knobs[0].value, "pcf");
    EXPECT_EQ(right->camera_cut, time == 0);
    EXPECT_EQ(passes_.contains("wipe"), time > 0);
  }
  EXPECT_THAT(wipe_->shown().note, HasSubstr("now | B: two pictures"));
  std::uint32_t drawn = 0;
  for (int still = 0; still < 20; ++still) drawn += frame(5.0) ? 1 : 0;
  EXPECT_EQ(drawn, SideTiming::kFrames - 1) << "at rest the last one stays";
  EXPECT_TRUE(passes_.contains("wipe"));
  filter->value = "hard";
  wipe_->set({.on = true, .side = WipeSide::kept_b, .kept = kept});
  EXPECT_TRUE(frame(5.0)) << "B was kept anew";
}

TEST_F(WipeTest, the_picture_is_beside_the_view_that_is_shown) {
  view_.visualizer = "lights_approx";
  wipe_->set({.on = true, .side = WipeSide::picture});
  const auto right = frame();
  ASSERT_TRUE(right);
  EXPECT_EQ(right->visualizer, "none");
  EXPECT_THAT(right->knobs, IsEmpty());
}

TEST_F(WipeTest, two_views_are_beside_each_other) {
  view_.visualizer = "depth";
  wipe_->set({.on = true, .side = WipeSide::view, .visualizer = "lights_approx"});
  EXPECT_EQ(frame().value().visualizer, "lights_approx");
  EXPECT_THAT(wipe_->shown().note, HasSubstr("now | view lights_approx"));
  wipe_->set({.on = true, .side = WipeSide::view, .visualizer = "normal"});
  EXPECT_EQ(frame().value().visualizer, "normal");
  // It needs lights.culling=tiled.
  wipe_->set({.on = true, .side = WipeSide::view, .visualizer = "lights_approx"});
  ASSERT_TRUE(session_->renderer->knobs().set("lights.culling", "brute").ok());
  EXPECT_EQ(frame().value().visualizer, "none");
}

TEST_F(WipeTest, a_view_that_kept_settings_do_not_have_is_left_out_there) {
  view_.visualizer = "lights_approx";  // needs lights.culling=tiled
  wipe_->set({.on = true, .side = WipeSide::kept_a, .kept = {{"lights.culling", "brute"}}});
  EXPECT_EQ(frame().value().visualizer, "none");
  wipe_->set({.on = true, .side = WipeSide::kept_a, .kept = {{"shadows.filter", "pcf"}}});
  EXPECT_EQ(frame(1.0).value().visualizer, "lights_approx");
}

TEST_F(WipeTest, turned_off_it_leaves_no_memory) {
  const auto bytes = [&] {
    static_cast<void>(session_->renderer->wait());
    session_->renderer->free_idle_memory();
    std::uint64_t sum = 0;
    for (const gpu::ModuleMemory& memory : session_->device->memory()) sum += memory.bytes;
    return sum;
  };
  static_cast<void>(frame());
  const std::uint64_t before = bytes();
  wipe_->set({.on = true});
  for (int i = 0; i < 6; ++i) static_cast<void>(frame());
  EXPECT_GT(bytes(), before);
  wipe_->set({.on = false});
  static_cast<void>(frame());
  EXPECT_FALSE(passes_.contains("wipe"));
  EXPECT_EQ(bytes(), before);
}

}  // namespace
}  // namespace gloam
