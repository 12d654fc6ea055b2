// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/output/numbered_path.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

std::string numbered(const char* path, std::uint32_t number) {
  const auto parts = numbered_path(path);
  return parts ? parts->of(number) : "none";
}

TEST(NumberedPath, puts_the_number_in_its_place) {
  EXPECT_EQ(numbered("out/frame_%04d.png", 7), "out/frame_0007.png");
  EXPECT_EQ(numbered("%d", 12), "12");
  EXPECT_EQ(numbered("a%02d", 1234), "a1234");
  EXPECT_EQ(numbered("50%/%01d.exr", 3), "50%/3.exr") << "another percent sign stays";
  EXPECT_EQ(numbered("%03d_%d.png", 5), "005_%d.png") << "the first place only";
}

TEST(NumberedPath, other_paths_have_no_place) {
  for (const char* path : {"", "frame.png", "100%.png", "%4d.png", "%0d", "%00d", "%012d", "%x", "%"})
    EXPECT_FALSE(numbered_path(path)) << path;
}

}  // namespace
}  // namespace gloam
