// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shaders/reflections/shaders.h"
#include "tests/modules/reflections/support/reflection_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

/// Reflection images of a view that looks down at a floor.
struct GlossyImages {
  RenderView view;
  shaders::ReflectionConstants c{.unit_m = 1.0f};
  std::vector<ByteTexel> surface;  ///< spread, roughness, distance
  std::vector<vec4> color;

  [[nodiscard]] std::size_t texels() const { return std::size_t{c.size.x} * c.size.y; }
  [[nodiscard]] std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t{y} * c.size.x + x; }
  [[nodiscard]] bool reflects(std::size_t texel) const { return surface[texel][1] > 0; }

  /// Standard deviation in texels of a texel's blur, for this spread.
  [[nodiscard]] double sigma(std::uint32_t x, std::uint32_t y, double spread, bool columns) const {
    double sigma = static_cast<double>(c.blur_scale) * spread;
    const auto least = static_cast<double>(c.blur_across);
    if (c.pixel_roughness == 0) return columns ? sigma : sigma * least;
    const double roughness = surface[at(x, y)][1] / 255.0;
    sigma *= roughness * roughness;
    if (columns) return sigma;
    const dvec2 pixel = (dvec2(x, y) + 0.5) * double(c.scale);
    const PixelRay ray = pixel_ray(view, {2.0 * pixel.x / view.width - 1.0, 1.0 - 2.0 * pixel.y / view.height});
    // The sine of the angle between the view ray and the floor.
    return sigma * std::max(std::abs(glm::normalize(ray.direction).y), least);
  }
  /// Texels on each side; `sure` becomes false if rounding may decide.
  [[nodiscard]] std::int64_t reach(double sigma, bool& sure) const {
    const double exact = 2.0 * sigma;
    sure &= std::abs(exact - std::round(exact)) > 1e-4 * (1.0 + exact) || exact == 0.0;
    return std::min<std::int64_t>(static_cast<std::int64_t>(std::ceil(exact)), c.blur_radius);
  }
};

class GlossyLines : public KernelTest {
 protected:
  [[nodiscard]] static GlossyImages images(std::uint32_t width, std::uint32_t height, std::uint32_t scale = 2) {
    GlossyImages made;
    made.view = make_view(look_at({0.0, 1.5, 4.0}, {0.0, 0.0, 0.0}, width * scale, height * scale), 0);
    made.c = reflection_constants(made.view, scale);
    made.surface.assign(made.texels(), ByteTexel{128, 128, 0, 0});
    made.color.assign(made.texels(), vec4(0.5f));
    return made;
  }
  /// Random spreads, roughnesses and colours; a part of the texels does not reflect.
  [[nodiscard]] static GlossyImages random_images(ProxyRandom& random, std::uint32_t width, std::uint32_t height) {
    GlossyImages made = images(width, height);
    for (std::size_t i = 0; i < made.texels(); ++i) {
      const bool reflects = !random.one_in(4);
      made.surface[i] = {static_cast<std::uint8_t>(random.one_in(8) ? random.index(256) : random.index(40)),
                         static_cast<std::uint8_t>(reflects ? 1 + random.index(255) : 0), 0, 0};
      for (int k = 0; k < 4; ++k)
        made.color[i][k] = half_to_float(float_to_half(static_cast<float>(random.between(0.0, 4.0))));
    }
    made.c.blur_radius = random.one_in(2) ? GLOAM_MOST_BLUR_RADIUS : 5;
    made.c.blur_scale = 40.0f;
    return made;
  }
  [[nodiscard]] std::vector<std::uint8_t> dilate(const GlossyImages& in, bool columns) {
    Kernel kernel(device(), shaders::reflections::dilate_comp, {{"kColumns", columns ? 1u : 0u}});
    bind(kernel, in);
    kernel.sampled_image(2, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
    kernel.sampled_image(3, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
    kernel.output_image(4, gpu::Format::r8_unorm, in.c.size.x, in.c.size.y);
    run(kernel, in, columns);
    std::vector<std::uint8_t> dilated = kernel.read<std::uint8_t>(4);
    dilated.resize(in.texels());
    return dilated;
  }
  [[nodiscard]] std::vector<vec4> blur(const GlossyImages& in, const std::vector<std::uint8_t>& spread, bool columns) {
    Kernel kernel(device(), shaders::reflections::blur_comp, {{"kColumns", columns ? 1u : 0u}});
    bind(kernel, in);
    kernel.sampled_image(2, gpu::Format::r8_unorm, in.c.size.x, in.c.size.y, spread);
    kernel.sampled_image(3, gpu::Format::rgba8_unorm, in.c.size.x, in.c.size.y, in.surface);
    kernel.sampled_image(4, gpu::Format::rgba32_float, in.c.size.x, in.c.size.y, in.color);
    kernel.output_image(5, gpu::Format::rgba16_float, in.c.size.x, in.c.size.y);
    run(kernel, in, columns);
    return from_half(kernel.read<HalfTexel>(5));
  }
  [[nodiscard]] static std::vector<std::uint8_t> own_spread(const GlossyImages& in) {
    std::vector<std::uint8_t> spread;
    for (const ByteTexel& texel : in.surface) spread.push_back(texel[0]);
    return spread;
  }

 private:
  static void bind(Kernel& kernel, const GlossyImages& in) {
    kernel.input(0, std::vector{view_constants(in.view)});
    kernel.input(1, std::vector{in.c});
  }
  static void run(Kernel& kernel, const GlossyImages& in, bool columns) {
    const uvec2 lines = columns ? uvec2(in.c.size.y, in.c.size.x) : in.c.size;
    kernel.run((lines.x + GLOAM_BLUR_GROUP - 1) / GLOAM_BLUR_GROUP, lines.y);
  }
};

const std::vector<uvec2> kLineSizes = {{1, 1}, {4, 3}, {63, 5}, {64, 2}, {65, 7}, {130, 3}, {3, 131}, {97, 33}};

TEST_F(GlossyLines, dilation_is_the_greatest_spread_of_all_texels_whose_blur_reaches) {
  ProxyRandom random(41);
  std::size_t compared = 0, widened = 0;
  for (const uvec2 size : kLineSizes)
    for (const bool columns : {false, true})
      for (const std::uint32_t by_roughness : {1u, 0u}) {
        GlossyImages in = random_images(random, size.x, size.y);
        in.c.pixel_roughness = by_roughness;
        if (by_roughness == 0) in.c.blur_across = 0.5f;
        const std::vector<std::uint8_t> dilated = dilate(in, columns);
        for (std::uint32_t y = 0; y < size.y; ++y)
          for (std::uint32_t x = 0; x < size.x; ++x) {
            if (!in.reflects(in.at(x, y))) {
              ASSERT_EQ(dilated[in.at(x, y)], 0);
              continue;
            }
            bool sure = true;
            std::uint8_t expected = in.surface[in.at(x, y)][0];
            const std::uint32_t along = columns ? y : x, length = columns ? size.y : size.x;
            for (std::uint32_t k = 0; k < length; ++k) {
              const uvec2 other = columns ? uvec2(x, k) : uvec2(k, y);
              const ByteTexel& texel = in.surface[in.at(other.x, other.y)];
              if (texel[1] == 0) continue;
              const double sigma = in.sigma(other.x, other.y, texel[0] / 255.0, columns);
              if (std::abs(std::int64_t{k} - along) <= in.reach(sigma, sure)) expected = std::max(expected, texel[0]);
            }
            if (!sure) continue;
            ++compared;
            widened += expected > in.surface[in.at(x, y)][0] ? 1 : 0;
            ASSERT_EQ(dilated[in.at(x, y)], expected) << size.x << "x" << size.y << ", " << x << ", " << y << columns;
          }
      }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(widened, 1000u);
}

TEST_F(GlossyLines, blur_is_a_gaussian_over_the_texels_that_reflect) {
  ProxyRandom random(42);
  std::size_t blurred = 0;
  for (const uvec2 size : kLineSizes)
    for (const bool columns : {false, true})
      for (const std::uint32_t by_roughness : {1u, 0u}) {
        GlossyImages in = random_images(random, size.x, size.y);
        in.c.pixel_roughness = by_roughness;
        if (by_roughness == 0) in.c.blur_across = 0.5f, in.c.blur_scale = 12.0f;
        const std::vector<std::uint8_t> spread = own_spread(in);
        const std::vector<vec4> result = blur(in, spread, columns);
        for (std::uint32_t y = 0; y < size.y; ++y)
          for (std::uint32_t x = 0; x < size.x; ++x) {
            const std::size_t own = in.at(x, y);
            if (!in.reflects(own)) {
              ASSERT_EQ(result[own], vec4(0.0f));
              continue;
            }
            bool sure = true;
            const double sigma = in.sigma(x, y, spread[own] / 255.0, columns);
            const std::int64_t reach = in.reach(sigma, sure);
            if (!sure || std::abs(sigma - 0.15) < 0.01) continue;
            dvec4 sum(0.0);
            double total = 0.0;
            const std::int64_t along = columns ? y : x, length = columns ? size.y : size.x;
            for (std::int64_t k = std::max<std::int64_t>(along - reach, 0); k <= std::min(along + reach, length - 1);
                 ++k) {
              const std::size_t other =
                  columns ? in.at(x, static_cast<std::uint32_t>(k)) : in.at(static_cast<std::uint32_t>(k), y);
              const double d = static_cast<double>(k - along);
              if (!in.reflects(other)) continue;
              const double weight = d == 0.0 ? 1.0 : std::exp(-0.5 * d * d / std::max(sigma * sigma, 1e-12));
              sum += weight * dvec4(in.color[other]);
              total += weight;
            }
            ASSERT_LT(glm::length(dvec4(result[own]) - sum / total), 8e-3)
                << size.x << "x" << size.y << ", " << x << ", " << y << ", sigma " << sigma;
            blurred += sigma > 1.0 ? 1 : 0;
          }
      }
  EXPECT_GT(blurred, 1000u);
}

TEST_F(GlossyLines, a_constant_picture_stays_constant_and_silhouettes_do_not_bleed) {
  ProxyRandom random(43);
  for (const bool columns : {false, true}) {
    GlossyImages in = random_images(random, 97, 41);
    const float huge = 60000.0f, nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < in.texels(); ++i)
      in.color[i] = in.reflects(i) ? vec4(0.25f, 0.5f, 1.0f, 0.75f) : vec4(i % 2 == 0 ? huge : nan);
    const std::vector<vec4> result = blur(in, std::vector<std::uint8_t>(in.texels(), 255), columns);
    for (std::size_t i = 0; i < in.texels(); ++i)
      for (int k = 0; k < 4; ++k) ASSERT_NEAR(result[i][k], in.reflects(i) ? in.color[i][k] : 0.0f, 1e-3f) << i;
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
