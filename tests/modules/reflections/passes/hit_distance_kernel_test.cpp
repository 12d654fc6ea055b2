// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/math/types.h"
#include "shaders/reflections_test/shaders.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSide = 256;  // texels of the test images
constexpr std::uint32_t kValues = kSide * kSide;

using Texel = std::array<std::uint8_t, 4>;

class HitDistances : public test::KernelTest {
 protected:
  /// The texels that hold these distances; at most kValues.
  std::vector<Texel> packed(std::vector<float> metres) {
    const std::size_t count = metres.size();
    metres.resize(kValues, 0.0f);
    return run<Texel>(0, metres, std::vector<Texel>(kValues), 1, count);
  }
  std::vector<float> unpacked(std::vector<Texel> texels) {
    const std::size_t count = texels.size();
    texels.resize(kValues);
    return run<float>(1, std::vector<float>(1), texels, 3, count);
  }

 private:
  template <class T>
  std::vector<T> run(std::uint32_t unpack, const std::vector<float>& metres, const std::vector<Texel>& texels,
                     std::uint32_t result, std::size_t count) {
    test::Kernel kernel(device(), shaders::reflections_test::hit_distances_comp, {{"kUnpack", unpack}});
    kernel.input(0, metres);
    kernel.output_image(1, gpu::Format::rgba8_unorm, kSide, kSide);
    kernel.sampled_image(2, gpu::Format::rgba8_unorm, kSide, kSide, texels);
    kernel.output(3, kValues * sizeof(float));
    kernel.run(kValues / 64);
    std::vector<T> all = kernel.template read<T>(result);
    all.resize(count);
    return all;
  }
};

std::uint32_t centimetres(const Texel& texel) { return texel[0] + 256u * texel[1]; }

TEST_F(HitDistances, every_centimetre_survives_the_image) {
  std::vector<float> metres(kValues);
  for (std::uint32_t i = 0; i < kValues; ++i) metres[i] = static_cast<float>(i / 100.0);
  const std::vector<Texel> texels = packed(metres);
  for (std::uint32_t i = 0; i < kValues; ++i) ASSERT_EQ(centimetres(texels[i]), i);
  const std::vector<float> back = unpacked(texels);
  for (std::uint32_t i = 0; i < kValues; ++i) ASSERT_NEAR(back[i], i / 100.0, 1e-7 * i) << i;
}

TEST_F(HitDistances, are_rounded_to_the_nearest_centimetre) {
  std::mt19937 random(18);
  std::uniform_real_distribution<float> any(0.0f, 660.0f);
  std::vector<float> metres(kValues);
  for (float& distance : metres) distance = any(random);
  const std::vector<Texel> texels = packed(metres);
  for (std::uint32_t i = 0; i < kValues; ++i) {
    const double expected = std::min(100.0 * static_cast<double>(metres[i]), 65535.0);
    ASSERT_NEAR(centimetres(texels[i]), expected, 0.505) << metres[i];
  }
}

TEST_F(HitDistances, that_do_not_fit_saturate_and_those_that_mean_nothing_are_zero) {
  const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> metres = {0.0f,  -0.0f,  2.55f, 2.56f, 655.35f,   655.36f, 1000.0f,
                                     3e38f, -1e-6f, -5.0f, nan,   -infinite, infinite};
  const std::vector<std::uint32_t> expected = {0, 0, 255, 256, 65535, 65535, 65535, 65535, 0, 0, 0, 0, 65535};
  const std::vector<Texel> texels = packed(metres);
  for (std::size_t i = 0; i < metres.size(); ++i) EXPECT_EQ(centimetres(texels[i]), expected[i]) << metres[i];
  const std::vector<float> back = unpacked({{255, 255, 7, 9}, {0, 0, 7, 9}, {0, 1, 7, 9}});
  EXPECT_FLOAT_EQ(back[0], 655.35f);
  EXPECT_EQ(back[1], 0.0f);
  EXPECT_FLOAT_EQ(back[2], 2.56f);
}

}  // namespace
}  // namespace gloam
