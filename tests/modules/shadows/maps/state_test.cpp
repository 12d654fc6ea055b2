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

}  // namespace
}  // namespace gloam
