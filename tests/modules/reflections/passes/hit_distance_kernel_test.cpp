// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "modules/reflections/reference/hit_distances.h"
#include "modules/reflections/reference/kernel_checks.h"
#include "tests/support/kernel.h"

namespace gloam {
namespace {

constexpr std::uint32_t kValues = kMostHitDistances;

class HitDistances : public test::KernelTest {
 protected:
  std::vector<HitTexel> packed(const std::vector<float>& metres) {
    return test::value_of(pack_hit_distances(KernelLab(device(), test::gpu_log()), metres));
  }
  std::vector<float> unpacked(const std::vector<HitTexel>& texels) {
    return test::value_of(unpack_hit_distances(KernelLab(device(), test::gpu_log()), texels));
  }
};

// Hard case: selftest.distances
TEST_F(HitDistances, every_centimetre_survives_the_image) {
  std::vector<float> metres(kValues);
  for (std::uint32_t i = 0; i < kValues; ++i) metres[i] = static_cast<float>(i / 100.0);
  const std::vector<HitTexel> texels = packed(metres);
  for (std::uint32_t i = 0; i < kValues; ++i) ASSERT_EQ(centimetres_of(texels[i]), i);
  const std::vector<float> back = unpacked(texels);
  for (std::uint32_t i = 0; i < kValues; ++i) ASSERT_NEAR(back[i], i / 100.0, 1e-7 * i) << i;
}

TEST_F(HitDistances, are_rounded_to_the_nearest_centimetre) {
  std::vector<KernelCheck> checks = reflection_kernel_checks();
  EXPECT_EQ(std::erase_if(checks, [](const KernelCheck& check) { return check.name != "kernel.hit_distances"; }),
            reflection_kernel_checks().size() - 1);
  expect_holds(checks);
}

// Hard case: reflections.distance_0, reflections.distance_255, reflections.distance_256, reflections.distance_65535
// Hard case: reflections.distance_beyond
TEST_F(HitDistances, that_do_not_fit_saturate_and_those_that_mean_nothing_are_zero) {
  const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> metres = {0.0f,  -0.0f,  2.55f, 2.56f, 655.35f,   655.36f, 1000.0f,
                                     3e38f, -1e-6f, -5.0f, nan,   -infinite, infinite};
  const std::vector<std::uint32_t> expected = {0, 0, 255, 256, 65535, 65535, 65535, 65535, 0, 0, 0, 0, 65535};
  const std::vector<HitTexel> texels = packed(metres);
  for (std::size_t i = 0; i < metres.size(); ++i) EXPECT_EQ(centimetres_of(texels[i]), expected[i]) << metres[i];
  const std::vector<float> back = unpacked({{255, 255, 7, 9}, {0, 0, 7, 9}, {0, 1, 7, 9}});
  EXPECT_FLOAT_EQ(back[0], 655.35f);
  EXPECT_EQ(back[1], 0.0f);
  EXPECT_FLOAT_EQ(back[2], 2.56f);
}

}  // namespace
}  // namespace gloam
