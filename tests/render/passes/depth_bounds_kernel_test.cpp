// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "engine/math/types.h"
#include "engine/render/outputs.h"
#include "shaders/render/shaders.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

struct Depths {
  std::uint32_t width;
  std::uint32_t height;
  std::vector<float> texels;

  [[nodiscard]] std::uint32_t tiles_x() const { return (width + kTileSize - 1) / kTileSize; }
  [[nodiscard]] std::uint32_t tiles_y() const { return (height + kTileSize - 1) / kTileSize; }
};

/// Farthest and nearest depth of every tile, sky excluded.
std::vector<vec2> bounds_on_the_cpu(const Depths& depths) {
  std::vector<vec2> bounds;
  for (std::uint32_t ty = 0; ty < depths.tiles_y(); ++ty) {
    for (std::uint32_t tx = 0; tx < depths.tiles_x(); ++tx) {
      vec2 tile(1.0f, 0.0f);
      for (std::uint32_t y = ty * kTileSize; y < std::min(depths.height, (ty + 1) * kTileSize); ++y) {
        for (std::uint32_t x = tx * kTileSize; x < std::min(depths.width, (tx + 1) * kTileSize); ++x) {
          const float depth = depths.texels[std::size_t{y} * depths.width + x];
          if (depth > 0.0f) tile = {std::min(tile.x, depth), std::max(tile.y, depth)};
        }
      }
      bounds.push_back(tile);
    }
  }
  return bounds;
}

class DepthBoundsKernel : public test::KernelTest {
 protected:
  void expect_the_same(const Depths& depths) {
    test::Kernel kernel(device(), shaders::render::depth_bounds_comp);
    kernel.sampled_image(0, gpu::Format::d32_float, depths.width, depths.height, depths.texels);
    kernel.output_image(1, gpu::Format::rg32_float, depths.tiles_x(), depths.tiles_y());
    kernel.run((depths.tiles_x() + 7) / 8, (depths.tiles_y() + 7) / 8);
    const auto expected = bounds_on_the_cpu(depths);
    const auto bounds = kernel.read<vec2>(1);
    ASSERT_EQ(bounds.size(), expected.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
      ASSERT_EQ(bounds[i], expected[i]) << depths.width << "x" << depths.height << ", tile " << i;
  }
  [[nodiscard]] static Depths depths_of(std::uint32_t width, std::uint32_t height, float depth) {
    return {width, height, std::vector<float>(std::size_t{width} * height, depth)};
  }
};

TEST_F(DepthBoundsKernel, runs_at_the_subgroup_width_under_test) {
  const char* bits = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (bits == nullptr || device().info().type != gpu::DeviceType::cpu)
    GTEST_SKIP() << "this device chooses its width itself";
  EXPECT_EQ(device().info().subgroup_size, static_cast<std::uint32_t>(std::atoi(bits)) / 32u);
}

TEST_F(DepthBoundsKernel, finds_farthest_and_nearest_of_every_tile) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> depth(1e-6f, 1.0f);
  for (const auto& [width, height] :
       {std::pair{8u, 8u}, {1u, 1u}, {7u, 9u}, {64u, 64u}, {65u, 63u}, {130u, 5u}, {3u, 200u}, {320u, 180u}}) {
    Depths depths = depths_of(width, height, 0.0f);
    for (float& texel : depths.texels)
      if (random() % 3 != 0) texel = depth(random);
    expect_the_same(depths);
  }
}

TEST_F(DepthBoundsKernel, a_tile_of_sky_alone_is_one_and_zero) {
  Depths depths = depths_of(20, 12, 0.0f);
  expect_the_same(depths);
  depths.texels[19] = 0.25f;  // in the partial tile at the right edge
  expect_the_same(depths);
  EXPECT_EQ(bounds_on_the_cpu(depths)[2], vec2(0.25f));
  EXPECT_EQ(bounds_on_the_cpu(depths)[0], vec2(1.0f, 0.0f));
}

// Hard case: further.depth_1
TEST_F(DepthBoundsKernel, the_extremes_of_depth_count) {
  Depths depths = depths_of(8, 8, 1.0f);
  expect_the_same(depths);
  depths.texels[5] = 1.17549435e-38f;  // the smallest normal float
  expect_the_same(depths);
}

TEST_F(DepthBoundsKernel, one_texel_anywhere_in_a_tile_is_found) {
  for (std::size_t at = 0; at < 64; ++at) {
    Depths depths = depths_of(8, 8, 0.0f);
    depths.texels[at] = 0.5f;
    expect_the_same(depths);
  }
}

}  // namespace
}  // namespace gloam
