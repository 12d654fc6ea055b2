// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "modules/reflections/reference/glossy_lines.h"
#include "modules/reflections/reference/kernel_checks.h"
#include "tests/modules/reflections/support/reflection_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

class GlossyLines : public KernelTest {
 protected:
  [[nodiscard]] static GlossyImages images(std::uint32_t width, std::uint32_t height, std::uint32_t scale = 2) {
    return glossy_images(width, height, scale);
  }
  [[nodiscard]] static std::vector<std::uint8_t> dilate(const GlossyImages& in, bool columns, bool direct = false) {
    return value_of(run_dilation(KernelLab(device(), gpu_log()), in, columns, direct));
  }
  [[nodiscard]] static BlurredLines both(const GlossyImages& in, const std::vector<std::uint8_t>& spread,
                                         bool columns) {
    const KernelLab lab(device(), gpu_log());
    BlurredLines lines = value_of(run_glossy_blur(lab, in, spread, columns, false));
    const BlurredLines tiles = value_of(run_glossy_blur(lab, in, spread, columns, true));
    for (std::size_t i = 0; i < lines.core.size(); ++i) {  // sums of another order, rounded to half floats
      EXPECT_LE(glm::length(tiles.core[i] - lines.core[i]), 2e-3f * (1.0f + glm::length(lines.core[i])))
          << "the kernel over tiles " << i;
      EXPECT_LE(glm::length(tiles.tail[i] - lines.tail[i]), 2e-3f * (1.0f + glm::length(lines.tail[i])))
          << "the kernel over tiles, tail " << i;
    }
    return lines;
  }
  /// One Gaussian.
  [[nodiscard]] static std::vector<vec4> blur(GlossyImages in, const std::vector<std::uint8_t>& spread, bool columns) {
    in.c.blur_tail = in.c.blur_tail_share = 0.0f;
    return both(in, spread, columns).core;
  }
};

const std::vector<uvec2> kLineSizes = {{1, 1}, {4, 3}, {63, 5}, {64, 2}, {65, 7}, {130, 3}, {3, 131}, {97, 33}};

// Hard case: selftest.blur
TEST_F(GlossyLines, dilation_is_the_greatest_spread_of_all_texels_whose_blur_reaches) {
  std::mt19937 random(41);
  std::size_t compared = 0, widened = 0;
  for (const uvec2 size : kLineSizes)
    for (const bool columns : {false, true})
      for (const std::uint32_t by_roughness : {1u, 0u})
        for (const bool direct : {false, true}) {
          GlossyImages in = random_glossy_images(random, size.x, size.y);
          in.c.pixel_roughness = by_roughness;
          if (by_roughness == 0) in.c.blur_across = 0.5f;
          const std::vector<std::uint8_t> dilated = dilate(in, columns, direct);
          for (std::uint32_t y = 0; y < size.y; ++y)
            for (std::uint32_t x = 0; x < size.x; ++x) {
              const auto expected = dilated_twin(in, x, y, columns, direct);
              if (!expected) continue;
              ++compared;
              widened += *expected > in.surface[in.at(x, y)][0] ? 1 : 0;
              ASSERT_EQ(dilated[in.at(x, y)], *expected)
                  << size.x << "x" << size.y << ", " << x << ", " << y << columns << direct;
            }
        }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(widened, 1000u);
}

// Hard case: selftest.blur
TEST_F(GlossyLines, blur_is_two_gaussians_over_the_texels_that_reflect) {
  std::mt19937 random(42);
  std::size_t blurred = 0;
  for (const uvec2 size : kLineSizes)
    for (const bool columns : {false, true})
      for (const std::uint32_t by_roughness : {1u, 0u}) {
        GlossyImages in = random_glossy_images(random, size.x, size.y);
        in.c.pixel_roughness = by_roughness;
        if (by_roughness == 0) in.c.blur_across = 0.5f, in.c.blur_scale = 12.0f;
        const std::vector<std::uint8_t> spread = in.own_spread();
        const BlurredLines result = both(in, spread, columns);
        for (std::uint32_t y = 0; y < size.y; ++y)
          for (std::uint32_t x = 0; x < size.x; ++x) {
            const std::size_t own = in.at(x, y);
            const double sigma = in.sigma(x, y, spread[own] / 255.0, columns);
            const auto expected = blurred_twin(in, spread, x, y, columns);
            if (!expected) continue;
            ASSERT_LT(glm::length(dvec4(result.core[own]) - expected->core), 8e-3)
                << size.x << "x" << size.y << ", " << x << ", " << y << ", sigma " << sigma;
            ASSERT_LT(glm::length(dvec4(result.tail[own]) - expected->tail), 8e-3)
                << size.x << "x" << size.y << ", " << x << ", " << y << ", sigma " << sigma;
            blurred += in.reflects(own) && sigma > 1.0 ? 1 : 0;
          }
      }
  EXPECT_GT(blurred, 1000u);
}

TEST_F(GlossyLines, hold_in_the_self_test) { expect_holds(reflection_kernel_checks()); }

TEST_F(GlossyLines, a_constant_picture_stays_constant_and_silhouettes_do_not_bleed) {
  std::mt19937 random(43);
  for (const bool columns : {false, true}) {
    GlossyImages in = random_glossy_images(random, 97, 41);
    const float huge = 60000.0f, nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < in.texels(); ++i)
      in.color[i] = in.reflects(i) ? vec4(0.25f, 0.5f, 1.0f, 0.75f) : vec4(i % 2 == 0 ? huge : nan);
    in.tail = in.color;
    const BlurredLines result = both(in, std::vector<std::uint8_t>(in.texels(), 255), columns);
    for (const std::vector<vec4>& lines : {result.core, result.tail})
      for (std::size_t i = 0; i < in.texels(); ++i)
        for (int k = 0; k < 4; ++k) ASSERT_NEAR(lines[i][k], in.reflects(i) ? in.color[i][k] : 0.0f, 1e-3f) << i;
  }
}

TEST_F(GlossyLines, energy_is_kept_at_constant_distance_and_roughness) {
  for (const bool columns : {false, true})
    for (const std::uint8_t spread : {std::uint8_t{20}, std::uint8_t{80}, std::uint8_t{255}}) {
      GlossyImages in = images(101, 101, 1);
      in.c.pixel_roughness = 0;
      in.c.blur_across = 0.5f;
      in.c.blur_radius = 24;
      in.c.blur_scale = 12.0f;
      in.color.assign(in.texels(), vec4(0.0f));
      in.color[in.at(50, 50)] = vec4(100.0f);
      const std::vector<vec4> result = blur(in, std::vector<std::uint8_t>(in.texels(), spread), columns);
      double sum = 0.0, variance = 0.0;
      for (std::uint32_t k = 0; k < 101; ++k) {
        const vec4 value = result[columns ? in.at(50, k) : in.at(k, 50)];
        sum += static_cast<double>(value.r);
        variance += static_cast<double>(value.r) * (k - 50.0) * (k - 50.0) / 100.0;
      }
      EXPECT_NEAR(sum, 100.0, 1.0) << columns << ", " << int{spread};
      // A Gaussian that is cut at two standard deviations has 0.77 of its variance.
      const double sigma = 12.0 * spread / 255.0 * (columns ? 1.0 : 0.5);
      if (sigma > 1.5) {
        EXPECT_GT(std::sqrt(variance), 0.8 * sigma) << columns;
        EXPECT_LT(std::sqrt(variance), 1.0 * sigma) << columns;
      }
    }
}

TEST_F(GlossyLines, both_directions_make_the_sum_of_two_round_gaussians) {
  GlossyImages in = images(121, 121, 1);
  in.c.pixel_roughness = 0;
  in.c.blur_across = 1.0f;
  in.c.blur_radius = 60;
  in.c.blur_scale = 8.0f;
  in.c.blur_tail_share = 0.4f;
  in.color.assign(in.texels(), vec4(0.0f));
  in.color[in.at(60, 60)] = vec4(40000.0f);
  const std::vector<std::uint8_t> spread(in.texels(), 255);
  const BlurredLines columns = both(in, spread, true);
  in.color = columns.core, in.tail = columns.tail;
  const std::vector<vec4> result = both(in, spread, false).core;
  double worst = 0.0;
  for (std::uint32_t y = 30; y <= 90; ++y)
    for (std::uint32_t x = 30; x <= 90; ++x) {
      const double dx = x - 60.0, dy = y - 60.0;
      const auto gaussian = [&](double sigma) {
        const double reach = std::ceil(2.0 * sigma);
        if (std::abs(dx) > reach || std::abs(dy) > reach) return 0.0;
        double line = 0.0;
        for (double k = -reach; k <= reach; k += 1.0) line += std::exp(-0.5 * k * k / (sigma * sigma));
        return std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma)) / (line * line);
      };
      const double expected = 40000.0 * (0.6 * gaussian(8.0) + 0.4 * gaussian(20.0));
      worst = std::max(worst, std::abs(static_cast<double>(result[in.at(x, y)].r) - expected));
    }
  EXPECT_LT(worst, 0.002 * 40000.0 * 0.6 / (2.0 * 3.14159 * 64.0));
}

// Hard case: reflections.zero_specular
TEST_F(GlossyLines, zero_specular_everywhere_gives_zero) {
  for (const bool columns : {false, true}) {
    GlossyImages in = images(70, 9);
    in.surface.assign(in.texels(), ByteTexel{255, 0, 255, 255});
    for (const std::uint8_t value : dilate(in, columns)) ASSERT_EQ(value, 0);
    for (const vec4& value : blur(in, std::vector<std::uint8_t>(in.texels(), 255), columns))
      ASSERT_EQ(value, vec4(0.0f));
  }
}

TEST_F(GlossyLines, a_contact_stays_sharp_beside_a_wide_blur) {
  // Spread 0 at the left, a wide spread at the right: texels out of its reach keep their colour exactly.
  GlossyImages in = images(64, 4);
  in.c.pixel_roughness = 0;
  in.c.blur_across = 1.0f;
  in.c.blur_scale = 4.0f;
  in.c.blur_radius = 8;
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      in.surface[in.at(x, y)][0] = x < 32 ? 0 : 255;
      in.color[in.at(x, y)] = vec4(x % 2 == 0 ? 1.0f : 0.0f);
    }
  const std::vector<vec4> result = blur(in, dilate(in, false), false);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      if (x < 24) {
        EXPECT_EQ(result[in.at(x, y)], in.color[in.at(x, y)]) << x;
      } else if (x < 56) {
        EXPECT_NEAR(result[in.at(x, y)].r, 0.5f, 0.1f) << x;
      }
    }
}

TEST_F(GlossyLines, the_blur_is_wider_along_columns_than_along_rows) {
  for (const std::uint32_t by_roughness : {1u, 0u}) {
    GlossyImages in = images(65, 65, 1);
    in.c.pixel_roughness = by_roughness;
    in.c.blur_across = by_roughness != 0 ? 0.1f : 0.5f;
    in.c.blur_scale = by_roughness != 0 ? 30.0f : 8.0f;
    in.c.blur_radius = 24;
    in.color.assign(in.texels(), vec4(0.0f));
    in.color[in.at(32, 40)] = vec4(100.0f);
    const std::vector<std::uint8_t> spread(in.texels(), 200);
    const float across = blur(in, spread, false)[in.at(32, 40)].r, along = blur(in, spread, true)[in.at(32, 40)].r;
    EXPECT_GT(across, 1.5f * along) << by_roughness;
  }
}

}  // namespace
}  // namespace gloam::test
