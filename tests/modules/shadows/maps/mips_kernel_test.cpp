// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "modules/shadows/atlas/mip_places.h"
#include "tests/modules/shadows/support/maps.h"
#include "tests/support/kernel.h"

namespace gloam::test {
namespace {

struct Level {
  std::vector<double> depth;
  std::vector<vec2> bounds;
};

/// Expected mip: nearest depths of the blocks of the face's texels.
Level expected_nearest(const std::vector<float>& depths, std::uint32_t size, std::uint32_t mip) {
  const std::uint32_t side = size >> mip, block = 1u << mip;
  Level level;
  for (std::uint32_t at = 0; at < side * side; ++at) {
    vec2 bounds(1.0f, 0.0f);
    for (std::uint32_t i = 0; i < block * block; ++i) {
      const float d = depths[(at / side * block + i / block) * size + at % side * block + i % block];
      bounds = vec2(std::min(bounds.x, d), std::max(bounds.y, d));
    }
    level.depth.push_back(bounds.y);
    level.bounds.push_back(bounds);
  }
  return level;
}

/// Expected next mip: mean of distances (orthographic: of depths), without empty texels.
std::vector<double> expected_average(const std::vector<double>& finer, std::uint32_t finer_side, bool orthographic) {
  const std::uint32_t side = finer_side / 2;
  std::vector<double> coarse;
  for (std::uint32_t at = 0; at < side * side; ++at) {
    double sum = 0.0;
    int count = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const double d = finer[(at / side * 2 + i / 2) * finer_side + at % side * 2 + i % 2];
      if (d > 0.0) sum += orthographic ? d : 1.0 / d, ++count;
    }
    coarse.push_back(count == 0 ? 0.0 : orthographic ? sum / count : count / sum);
  }
  return coarse;
}

std::vector<float> random_depths(std::uint32_t size, std::uint32_t seed, int empty_percent) {
  std::mt19937 random(seed);
  std::vector<float> depths(std::size_t{size} * size);
  for (float& d : depths)
    d = static_cast<int>(random() % 100) < empty_percent ? 0.0f : static_cast<float>(random() % 1000000 + 1) * 1e-6f;
  return depths;
}

class ShadowMips : public KernelTest {
 protected:
  static constexpr std::uint32_t kAtlas = 512;
  static void expect_face(const std::vector<float>& atlas, const std::vector<vec2>& pyramid, std::vector<float> depths,
                          uvec2 origin, std::uint32_t size) {
    for (std::uint32_t mip = 0; size >> mip != 0; ++mip) {
      const Level level = expected_nearest(depths, size, mip);
      const uvec2 corner = mip_corner(kAtlas, mip) + origin / (1u << mip);
      const std::uint32_t side = size >> mip;
      int wrong = 0;
      for (std::uint32_t i = 0; i < side * side; ++i)
        wrong += atlas[(corner.y + i / side) * kAtlas * 3 / 2 + corner.x + i % side] != level.depth[i];
      EXPECT_EQ(wrong, 0) << "mip " << mip << " of a face of " << size;
      if (mip < GLOAM_SHADOW_PYRAMID_MIP) continue;
      const uvec2 low = mip_corner(kAtlas / 4, mip - GLOAM_SHADOW_PYRAMID_MIP) + origin / (1u << mip);
      for (std::uint32_t i = 0; i < side * side; ++i)
        wrong += pyramid[(low.y + i / side) * kAtlas * 3 / 8 + low.x + i % side] != level.bounds[i];
      EXPECT_EQ(wrong, 0) << "pyramid of mip " << mip << " of a face of " << size;
    }
  }
};

TEST_F(ShadowMips, every_mip_holds_the_nearest_and_the_pyramid_the_bounds) {
  ShadowMaps maps(device(), kAtlas);
  struct Face {
    std::uint32_t size;
    uvec2 origin;
    int empty;
  };
  const std::vector<Face> faces = {{256, {0, 0}, 0},   {256, {256, 256}, 30}, {128, {256, 0}, 5},
                                   {32, {384, 64}, 1}, {16, {496, 240}, 0},   {16, {480, 240}, 100}};
  for (const Face& face : faces) maps.add_face(random_depths(face.size, face.size, face.empty), face.origin, face.size);
  const auto atlas = maps.atlas();
  const auto pyramid = maps.pyramid();
  for (const Face& face : faces)
    expect_face(atlas, pyramid, random_depths(face.size, face.size, face.empty), face.origin, face.size);
}

TEST_F(ShadowMips, a_face_as_large_as_the_atlas_goes_down_to_one_texel) {
  ShadowMaps maps(device(), kAtlas);
  const auto depths = random_depths(kAtlas, 7, 1);
  maps.add_face(depths, uvec2(0), kAtlas);
  expect_face(maps.atlas(), maps.pyramid(), depths, uvec2(0), kAtlas);
}

TEST_F(ShadowMips, other_faces_stay_as_they_were) {
  ShadowMaps maps(device(), kAtlas);
  const auto first = random_depths(64, 1, 10);
  maps.add_face(first, {64, 64}, 64);
  maps.add_face(random_depths(16, 2, 10), {128, 64}, 16);
  maps.add_face(random_depths(64, 3, 10), {64, 128}, 64);
  expect_face(maps.atlas(), maps.pyramid(), first, {64, 64}, 64);
}

TEST_F(ShadowMips, coverage_is_the_share_of_the_nearest_surface) {
  constexpr std::uint32_t kSize = 128;
  constexpr float kNear = 0.5f, kFar = 0.1f;
  // A mix of near, far and empty texels.
  std::vector<float> depths = random_depths(kSize, 11, 0);
  for (float& d : depths) d = d < 0.3f ? kNear : d < 0.9f ? kFar : 0.0f;
  ShadowMaps maps(device(), kAtlas);
  maps.add_face(depths, {128, 256}, kSize, false, GLOAM_SHADOW_MIPS_COVERAGE, 0.01f);
  const auto atlas = maps.atlas();
  for (std::uint32_t mip = 1; mip <= 5; ++mip) {
    const uvec2 corner = mip_corner(kAtlas, mip) + uvec2(128, 256) / (1u << mip);
    const std::uint32_t side = kSize >> mip, block = 1u << mip;
    for (std::uint32_t at = 0; at < side * side; ++at) {
      double near = 0.0, far = 0.0;
      for (std::uint32_t i = 0; i < block * block; ++i) {
        const float d = depths[(at / side * block + i / block) * kSize + at % side * block + i % block];
        near += d == kNear ? 1.0 : 0.0;
        far += d == kFar ? 1.0 : 0.0;
      }
      const float held = atlas[(corner.y + at / side) * kAtlas * 3 / 2 + corner.x + at % side];
      const double share = near > 0.0 ? near : far;
      if (share == 0.0) {
        EXPECT_EQ(held, 0.0f);
        continue;
      }
      EXPECT_NEAR(held, near > 0.0 ? kNear : kFar, 1e-5f);
      const double covered = 1.0 - (std::bit_cast<std::uint32_t>(held) & 63u) / 64.0;
      EXPECT_NEAR(covered, share / (block * block), mip / 128.0 + 1.0 / 64.0) << "mip " << mip;
    }
  }
}

TEST_F(ShadowMips, a_surface_that_recedes_covers_its_texels_at_the_depth_of_their_middles) {
  constexpr std::uint32_t kSize = 64;
  constexpr float kTexel = 0.02f;  // tangent
  std::vector<float> depths;       // a plane that recedes 0.75 m per metre across
  const auto plane_at = [](float column) { return 0.05f / 3.0f * (1.0f - 0.75f * kTexel * (column - 32.0f)); };
  for (std::uint32_t i = 0; i < kSize * kSize; ++i) depths.push_back(plane_at(static_cast<float>(i % kSize)));
  ShadowMaps maps(device(), kAtlas);
  maps.add_face(depths, {0, 0}, kSize, false, GLOAM_SHADOW_MIPS_COVERAGE, 3.0f * kTexel);
  const auto atlas = maps.atlas();
  for (std::uint32_t mip = 1; mip <= 4; ++mip) {
    const uvec2 corner = mip_corner(kAtlas, mip);
    for (std::uint32_t x = 0; x < kSize >> mip; ++x) {
      const float held = atlas[corner.y * kAtlas * 3 / 2 + corner.x + x];
      EXPECT_EQ(std::bit_cast<std::uint32_t>(held) & 63u, 0u) << "mip " << mip << " column " << x;
      const float middle = (static_cast<float>(x) + 0.5f) * static_cast<float>(1u << mip) - 0.5f;
      EXPECT_NEAR(held, plane_at(middle), 2e-5f * held) << "mip " << mip << " column " << x;
    }
  }
}

TEST_F(ShadowMips, sixteen_bits_hold_rounded_depths_in_all_mips) {
  ShadowMaps maps(device(), kAtlas, gpu::Format::r16_unorm);
  auto depths = random_depths(128, 5, 3);
  maps.add_face(depths, {128, 256}, 128);
  for (float& d : depths) d = std::floor(d * 65535.0f + 0.5f) / 65535.0f;
  expect_face(maps.atlas(), maps.pyramid(), depths, {128, 256}, 128);
}

/// The texels of all mips (or pyramid levels) of a face, from an image that is 1.5 times as wide as `side`.
template <class Texel>
std::vector<Texel> all_mips(const std::vector<Texel>& image, std::uint32_t side, uvec2 origin, std::uint32_t size) {
  std::vector<Texel> found;
  for (std::uint32_t mip = 0; size >> mip != 0; ++mip) {
    const uvec2 corner = mip_corner(side, mip) + origin / (1u << mip);
    for (std::uint32_t i = 0; i < (size >> mip) * (size >> mip); ++i) {
      const uvec2 at = corner + uvec2(i % (size >> mip), i / (size >> mip));
      found.push_back(image[std::size_t{at.y} * side * 3 / 2 + at.x]);
    }
  }
  return found;
}

TEST_F(ShadowMips, a_copy_of_a_face_has_its_mips_and_pyramid_to_the_bit) {
  for (const gpu::Format format : {gpu::Format::r32_float, gpu::Format::r16_unorm})
    for (const std::uint32_t how : {GLOAM_SHADOW_MIPS_NEAREST, GLOAM_SHADOW_MIPS_AVERAGE, GLOAM_SHADOW_MIPS_COVERAGE})
      for (const std::uint32_t size : {16u, 32u, 128u}) {
        const bool orthographic = size == 32;
        ShadowMaps maps(device(), kAtlas, format);
        const auto beside = random_depths(size, 3, 20);
        const uvec2 from(128, 256), to(256, 128), other(to.x + size, to.y);
        maps.add_face(beside, other, size, orthographic, how, 0.01f);
        maps.add_face(random_depths(size, size, 20), from, size, orthographic, how, 0.01f);
        const auto before = maps.atlas();
        maps.copy_face(from, to, size, orthographic, how, 0.01f);
        const auto atlas = maps.atlas();
        const auto pyramid = maps.pyramid();
        EXPECT_EQ(all_mips(atlas, kAtlas, to, size), all_mips(before, kAtlas, from, size)) << how << ' ' << size;
        EXPECT_EQ(all_mips(atlas, kAtlas, from, size), all_mips(before, kAtlas, from, size)) << how << ' ' << size;
        EXPECT_EQ(all_mips(atlas, kAtlas, other, size), all_mips(before, kAtlas, other, size)) << how << ' ' << size;
        EXPECT_EQ(all_mips(pyramid, kAtlas / 4, to / 4u, size / 4), all_mips(pyramid, kAtlas / 4, from / 4u, size / 4))
            << how << ' ' << size;
      }
}

TEST_F(ShadowMips, means_are_of_distances_and_leave_empty_texels_out) {
  for (const bool orthographic : {false, true}) {
    ShadowMaps maps(device(), kAtlas);
    const std::uint32_t size = 64;
    const auto depths = random_depths(size, 11, 40);
    const uvec2 origin(128, 64);
    maps.add_face(depths, origin, size, orthographic, true);
    const auto atlas = maps.atlas();
    std::vector<double> level(depths.begin(), depths.end());
    for (std::uint32_t mip = 1; size >> mip != 0; ++mip) {
      level = expected_average(level, size >> (mip - 1), orthographic);
      const uvec2 corner = mip_corner(kAtlas, mip) + origin / (1u << mip);
      const std::uint32_t side = size >> mip;
      for (std::uint32_t i = 0; i < side * side; ++i) {
        const float got = atlas[(corner.y + i / side) * kAtlas * 3 / 2 + corner.x + i % side];
        ASSERT_NEAR(got, level[i], 1e-5 * level[i]) << "mip " << mip << " texel " << i;
      }
    }
    const auto pyramid = maps.pyramid();
    const Level bounds = expected_nearest(depths, size, 4);
    const uvec2 low = mip_corner(kAtlas / 4, 2) + origin / 16u;
    for (std::uint32_t i = 0; i < 16; ++i)
      EXPECT_EQ(pyramid[(low.y + i / 4) * kAtlas * 3 / 8 + low.x + i % 4], bounds.bounds[i]);
  }
}

}  // namespace
}  // namespace gloam::test
