// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/state.h"

#include <gtest/gtest.h>

#include <memory>

#include "engine/gpu/recording/device.h"

namespace gloam {
namespace {

TEST(ShadowStates, a_view_has_another_state_while_it_shares_an_atlas) {
  const auto device = gpu::make_recording_device();
  ShadowStates states;
  states.begin(*device);
  constexpr ViewId kMain{3}, kMirrored{7};
  ViewFaces alone{.owner = kMain}, shared{.owner = kMain, .shared = std::make_shared<SharedPlaces>()};
  ViewMapState& own = states.view(1, alone, kMain);
  ViewMapState& common = states.view(1, shared, kMain);
  EXPECT_NE(&own, &common) << "they describe two images";
  EXPECT_EQ(&states.view(1, shared, kMirrored), &common);
  EXPECT_EQ(states.find(1, alone), &own);
  EXPECT_EQ(states.find(1, shared), &common);
  common.counts.cached = own.counts.cached = 5;
  states.skip_frame(1, alone);
  EXPECT_EQ(own.counts.cached, 0u);
  EXPECT_EQ(common.counts.cached, 5u);
  states.release_view(kMain);
  EXPECT_EQ(states.find(1, alone), nullptr);
  EXPECT_NE(states.find(1, shared), nullptr) << "the mirrored view uses it";
  states.release();
}

TEST(ShadowStates, whose_turn_it_was_is_forgotten_when_nobody_takes_one) {
  const auto device = gpu::make_recording_device();
  ShadowStates states;
  const ViewFaces faces{.owner = ViewId{3}};
  const ShadowKnobs knobs;
  const auto next_frame = [&] {
    ASSERT_TRUE(device->begin_frame().ok());
    states.begin(*device);
    ASSERT_TRUE(device->submit_frame().ok());
  };
  const auto take = [&](std::uint32_t frame) {
    return states.take_turn(1, states.view(1, faces, ViewId{3}), knobs, frame);
  };
  next_frame();
  EXPECT_FALSE(take(1)) << "nobody has drawn there";
  states.commit_turn(1, states.view(1, faces, ViewId{3}), knobs);
  next_frame();
  EXPECT_TRUE(take(2));
  states.commit_turn(1, states.view(1, faces, ViewId{3}), knobs);
  for (int frame = 0; frame < 200; ++frame) {
    next_frame();
    static_cast<void>(states.view(1, faces, ViewId{3}));
  }
  EXPECT_FALSE(take(3));
  states.release();
}

}  // namespace
}  // namespace gloam
