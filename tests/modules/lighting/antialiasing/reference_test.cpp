// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/antialiasing/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/math/srgb.h"
#include "modules/lighting/outputs.h"
#include "tests/support/memory_store.h"

namespace gloam {
namespace {

/// A picture of one pixel that is white in every fourth frame and black in the others. One frame for four samples.
class Supersampled : public ::testing::Test {
 protected:
  Supersampled() {
    view_.width = view_.height = 1;
    add_knobs(knobs_, "lighting", kAntialiasing);
    frame_ = {.linear = {1, 1, {0.0f, 0.0f, 0.0f, 1.0f}}, .picture = {1, 1, {0, 0, 0, 255}}};
  }
  std::uint8_t draw(std::uint32_t samples) {
    const auto drawn =
        draw_supersampled({.world = world_,
                           .view = view_,
                           .knobs = knobs_,
                           .frame = frame_,
                           .samples = samples,
                           .executor = *executor_,
                           .redraw = [this](const auto& change, const auto& restore) -> Result<FramePictures> {
                             change(world_);
                             EXPECT_NE(world_.try_resource<PointSampledFrame>(), nullptr);
                             restore(world_);
                             const std::uint8_t white = drawn_++ % 4 == 0 ? 255 : 0;
                             return FramePictures{.linear = {}, .picture = {1, 1, {white, white, white, 255}}};
                           },
                           .store = &store_});
    EXPECT_TRUE(drawn.ok());
    return drawn->picture.rgba[1];
  }
  World world_;
  RenderView view_;
  KnobRegistry knobs_;
  FramePictures frame_;
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
  test::MemoryStore store_;
  std::uint32_t drawn_ = 0;
};

TEST_F(Supersampled, is_the_mean_of_light_not_of_codes) {
  EXPECT_EQ(draw(64), std::lround(255.0 * linear_to_srgb(0.25)));
  EXPECT_EQ(drawn_, 16u);
}

TEST_F(Supersampled, is_kept_for_the_same_frame_knobs_and_samples_alone) {
  const std::uint8_t mean = draw(64);
  EXPECT_EQ(draw(64), mean);
  EXPECT_EQ(drawn_, 16u) << "taken from the store";
  draw(32);
  EXPECT_EQ(drawn_, 16u) << "half of the samples were kept on the way";
  draw(20);
  EXPECT_EQ(drawn_, 21u) << "other samples";
  knobs_.set(kAntialiasing, Antialiasing::smaa);
  draw(64);
  EXPECT_EQ(drawn_, 37u) << "another knob";
  frame_.linear.rgba[0] = 1e-3f;
  draw(64);
  EXPECT_EQ(drawn_, 53u) << "other light, the same picture";
  view_.position.x += 1e-9;
  draw(64);
  EXPECT_EQ(drawn_, 69u) << "another place";
  for (auto& [identity, bytes] : store_.kept) bytes += "x";
  draw(64);
  EXPECT_EQ(drawn_, 85u) << "kept bytes of another size";
}

}  // namespace
}  // namespace gloam
