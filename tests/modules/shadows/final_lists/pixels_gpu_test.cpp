// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/classify.h"

namespace gloam {
namespace {

using ClassifyPixels = test::ClassifyShadowsTest;

TEST_F(ClassifyPixels, lists_hold_what_a_view_shows_at_each_pixel) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    random_scene(seed, 80, 56);
    ASSERT_NO_FATAL_FAILURE(expect_same_as_view("seed " + std::to_string(seed)));
  }
  set("shadows.visibility_bits", "4");
  random_scene(43);
  expect_same_as_view("4 bits");
  print("pixel by pixel");
  EXPECT_GT(compared, 10000u);
}

}  // namespace
}  // namespace gloam
