// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/recording.h"

#include <gtest/gtest.h>

namespace gloam::declare {
namespace {

TEST(Recordings, keep_only_what_the_last_frame_needs) {
  Recordings recordings;
  recordings.next("large").items.resize(1000);
  recordings.next("second").items.resize(1000);
  recordings.begin_frame();
  Recording& small = recordings.next("small");
  small.items.resize(10);
  small.steps.resize(2);
  EXPECT_GE(small.items.capacity(), 1000u);
  recordings.free_idle_memory();
  EXPECT_EQ(small.name, "small");
  EXPECT_EQ(small.items.size(), 10u);
  EXPECT_EQ(small.steps.size(), 2u);
  EXPECT_LT(small.items.capacity(), 100u);
  EXPECT_EQ(recordings.next("new").items.capacity(), 0u) << "the last frame had one pass";
}

}  // namespace
}  // namespace gloam::declare
