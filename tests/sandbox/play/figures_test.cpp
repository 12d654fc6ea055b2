// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/figures.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

using std::chrono::milliseconds;

constexpr PlayFigures::Clock::time_point kStart{milliseconds(5000)};

TEST(PlayFiguresTest, leave_the_first_half_out_of_the_rate) {
  PlayFigures figures(kStart);
  for (const int ms : {1210, 2000, 3000, 3050, 3100, 3150}) figures.add(kStart + milliseconds(ms), 640, 360, 0.5);
  EXPECT_EQ(figures.text(),
            "6 frames; the last 3: 20.0 frames/s (50 ms), drawn at 640x360 (50 %); first picture after 1.21 s");
}

TEST(PlayFiguresTest, of_one_frame_have_no_rate) {
  PlayFigures figures(kStart);
  figures.add(kStart + milliseconds(800), 320, 180, 1.0);
  EXPECT_EQ(figures.text(), "1 frame, drawn at 320x180 (100 %); first picture after 0.80 s");
}

TEST(PlayFiguresTest, of_a_run_without_a_frame_say_so) { EXPECT_EQ(PlayFigures(kStart).text(), "no frame was shown"); }

}  // namespace
}  // namespace gloam
