// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/mip_places.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace gloam {
namespace {

TEST(MipPlaces, are_the_documented_ones) {
  EXPECT_EQ(mip_corner(256, 0), uvec2(0, 0));
  EXPECT_EQ(mip_corner(256, 1), uvec2(256, 0));
  EXPECT_EQ(mip_corner(256, 2), uvec2(256, 128));
  EXPECT_EQ(mip_corner(256, 3), uvec2(256, 192));
}

TEST(MipPlaces, of_all_mips_lie_in_the_image_and_no_two_share_a_texel) {
  for (const std::uint32_t size : {1u, 2u, 16u, 128u}) {
    const uvec2 image = size_with_mips(size);
    std::vector<int> uses(std::size_t{image.x} * image.y);
    for (std::uint32_t mip = 0; size >> mip != 0; ++mip) {
      const uvec2 corner = mip_corner(size, mip);
      const std::uint32_t side = size >> mip;
      ASSERT_LE(corner.x + side, image.x) << "mip " << mip << " of " << size;
      ASSERT_LE(corner.y + side, image.y) << "mip " << mip << " of " << size;
      for (std::uint32_t i = 0; i < side * side; ++i)
        ++uses[std::size_t{corner.y + i / side} * image.x + corner.x + i % side];
    }
    for (const int count : uses) EXPECT_LE(count, 1) << size;
  }
}

}  // namespace
}  // namespace gloam
