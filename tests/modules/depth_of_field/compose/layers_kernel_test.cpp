// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "tests/modules/depth_of_field/support/dof_chain.h"

namespace gloam::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class DofLayersTest : public DofChainTest {
 protected:
  static constexpr std::uint32_t kWidth = 128, kHeight = 96;

  /// Pixels [left, right) × [top, bottom).
  struct Area {
    std::uint32_t left, top, right, bottom;
  };
  static void fill(DofInput& in, const Area& area, float coc, vec4 light) {
    for (std::uint32_t y = area.top; y < area.bottom; ++y)
      for (std::uint32_t x = area.left; x < area.right; ++x) {
        in.coc[in.at(x, y)] = coc;
        in.light[in.at(x, y)] = light;
      }
  }
  /// Calls check(result, input, name) for all kernels, resolutions and forms.
  template <class Check>
  static void each_kernel(DofInput in, const Check& check) {
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
      for (const bool full : {false, true})
        for (const DofKnobs::Cache cache : {DofKnobs::Cache::none, DofKnobs::Cache::channels}) {
          in.bokeh = bokeh;
          in.knobs.full_resolution = full;
          in.knobs.cache = cache;
          const std::string name = std::string(bokeh == Bokeh::round ? "round" : "hexagonal") +
                                   (full ? ", full" : ", half") +
                                   (cache == DofKnobs::Cache::none ? ", none" : ", channels");
          check(run(in), in, name);
        }
  }
  static std::uint32_t composed_tiles(const DofResult& result) {
    std::uint32_t tiles = 0;
    for (int kind = 0; kind < GLOAM_DOF_COMPOSE_KINDS; ++kind) tiles += result.lists[GLOAM_DOF_COMPOSE + kind].count;
    return tiles;
  }
  static bool is_finite(const vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
};
INSTANTIATE_TEST_SUITE_P(Variants, DofLayersTest, testing::Bool());

TEST_P(DofLayersTest, a_sharp_bright_object_does_not_bleed_into_the_blurred_background) {
  DofInput in(kWidth, kHeight, 12.0f, vec4(0.5f));
  const Area object{43, 31, 78, 70};
  fill(in, object, 0.0f, vec4(2000.0f));
  each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
    for (std::size_t i = 0; i < result.light.size(); ++i) {
      if (drawn.coc[i] == 0.0f)
        ASSERT_EQ(result.halves[i], dof_half(drawn.light[i])) << name << " " << i % kWidth << ", " << i / kWidth;
      else
        ASSERT_NEAR(result.light[i].x, 0.5f, 2e-3f) << name << " " << i % kWidth << ", " << i / kWidth;
    }
  });
}

TEST_P(DofLayersTest, pixels_in_focus_keep_their_light_to_the_bit_where_no_near_layer_reaches) {
  DofInput in(kWidth, kHeight, 0.0f, vec4(0.5f));
  for (std::size_t i = 0; i < in.light.size(); ++i) {
    in.light[i] = vec4(0.001f * static_cast<float>(i % 777), 100.0f / static_cast<float>(1 + i % 91), 1e-6f, 0.25f);
    in.coc[i] = i % 5 == 0 ? -0.4f : 0.3f;
  }
  fill(in, {0, 0, 40, 40}, 14.0f, vec4(3.0f));
  const Area near{100, 60, 110, 70};
  fill(in, near, -9.0f, vec4(5.0f));
  each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
    std::size_t kept = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        // The kernel of the hexagon reaches 9 pixels far, the round one 13, and interpolation of layers of half the
        // size two more. Each of the two passes of the hexagon spreads slanted lines over one more row of texels.
        const bool hexagonal = drawn.bokeh == Bokeh::hexagonal;
        const std::uint32_t columns = hexagonal ? 12 : 16,
                            rows = hexagonal ? 12 + (drawn.knobs.full_resolution ? 2 : 4) : 16;
        const bool reached =
            x + columns > near.left && x < near.right + columns && y + rows > near.top && y < near.bottom + rows;
        if (reached || std::abs(drawn.coc[drawn.at(x, y)]) > 0.5f) continue;
        ASSERT_EQ(result.halves[drawn.at(x, y)], dof_half(drawn.light[drawn.at(x, y)]))
            << name << " " << x << ", " << y;
        ++kept;
      }
    EXPECT_GT(kept, std::size_t{kWidth} * kHeight / 2);
  });
}

TEST_P(DofLayersTest, a_picture_in_focus_dispatches_no_tiles) {
  const DofInput in(kWidth, kHeight, 0.2f, vec4(0.5f));
  for (const shaders::DofList& list : run(in).lists) {
    EXPECT_EQ(list.count, 0u);
    EXPECT_EQ(list.groups_x, 0u);
  }
}

TEST_P(DofLayersTest, lists_hold_the_tiles_that_are_blurred) {
  DofInput in(kWidth, kHeight, 0.0f, vec4(0.5f));  // 8 × 6 tiles
  in.coc[in.at(0, 0)] = 5.0f;
  const DofResult far = run(in);
  EXPECT_EQ(composed_tiles(far), 1u);
  EXPECT_EQ(far.lists[GLOAM_DOF_NEAR_TILES].count, 0u);
  in.coc[in.at(0, 0)] = -5.0f;
  const DofResult near = run(in);
  EXPECT_EQ(composed_tiles(near), 4u);  // with the neighbours
  EXPECT_EQ(near.lists[GLOAM_DOF_NEAR_TILES].count, 4u);
}

TEST_P(DofLayersTest, near_objects_spread_over_a_sharp_background) {
  DofInput in(kWidth, kHeight, 0.0f, vec4(0.1f));
  const Area object{50, 0, 78, kHeight};
  fill(in, object, -10.0f, vec4(1.0f));
  each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
    const auto light = [&](std::uint32_t x) { return result.light[drawn.at(x, 48)].x; };
    EXPECT_NEAR(light(64), 1.0f, 4e-3f) << name;
    EXPECT_GT(light(object.left - 3), 0.2f) << name;
    EXPECT_GT(light(object.right + 2), 0.2f) << name;
    EXPECT_EQ(light(object.left - 17), light(0)) << name;  // the round kernel is 1.4 circles wide
    EXPECT_EQ(light(object.right + 16), light(0)) << name;
    for (std::uint32_t x = object.left - 18; x < 64; ++x) EXPECT_LE(light(x), light(x + 1) + 2e-3f) << name << " " << x;
    for (std::uint32_t x = object.right + 17; x > 65; --x)
      EXPECT_LE(light(x), light(x - 1) + 2e-3f) << name << " " << x;
  });
}

/// Share of an aperture, centred `distance` before an upright edge, that lies on the other side of the edge. A hexagon
/// has corners at the top and the bottom.
double aperture_beyond(Bokeh bokeh, double distance, double radius) {
  const double t = distance / radius;
  if (bokeh == Bokeh::round) {
    const double d = std::clamp(t, -1.0, 1.0);
    return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
  }
  // The hexagon is 2 − 2 |x| / √3 high at x; its area is 1.5 √3.
  const double widest = std::sqrt(0.75), d = std::clamp(t, -widest, widest);
  const auto area = [](double x) { return 2.0 * x - x * std::abs(x) / std::sqrt(3.0); };
  return (area(widest) - area(d)) / (1.5 * std::sqrt(3.0));
}

// Wide, and narrower than its circle: through the lens both show what is behind them. Circles of each level.
TEST_P(DofLayersTest, near_objects_are_as_solid_as_through_a_lens) {
  for (const float circle : {2.0f, 4.5f, 7.0f, 10.0f, 13.0f})
    for (const auto& [left, right] : {std::pair{50u, 78u}, {60u, 72u}, {62u, 66u}})
      for (const auto& [object, ground] : {std::pair{1.0f, 0.1f}, {0.1f, 1.0f}}) {
        DofInput in(kWidth, kHeight, 0.0f, vec4(ground));
        fill(in, {left, 0, right, kHeight}, -circle, vec4(object));
        each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
          // Layers of half the size are softer than circles of two pixels.
          if (circle < 4.0f && !drawn.knobs.full_resolution) return;
          const std::string which = name + ", " + std::to_string(right - left) + " wide, " + std::to_string(object) +
                                    ", circle " + std::to_string(circle);
          double covered = 0.0, whole = 0.0;
          for (std::uint32_t x = 0; x < kWidth; ++x) {
            const double alpha = static_cast<double>((result.light[drawn.at(x, 48)].x - ground) / (object - ground));
            const double expected = aperture_beyond(drawn.bokeh, left - (x + 0.5), double{circle}) -
                                    aperture_beyond(drawn.bokeh, right - (x + 0.5), double{circle});
            EXPECT_NEAR(alpha, expected, 0.05) << which << " " << x;
            covered += alpha;
            whole += expected;
          }
          EXPECT_NEAR(covered / whole, 1.0, 0.03) << which;
        });
      }
}

// The light behind a wire is that of a ground that lies before the focus as well.
TEST_P(DofLayersTest, near_objects_show_a_ground_behind_them_that_is_before_the_focus) {
  for (const float circle : {7.0f, 11.0f})
    for (const float behind : {0.7f, 2.0f, 3.0f})
      for (const auto& [left, right] : {std::pair{50u, 78u}, {60u, 68u}, {62u, 66u}})
        for (const auto& [object, ground] : {std::pair{1.0f, 0.1f}, {0.1f, 1.0f}}) {
          DofInput in(kWidth, kHeight, -behind, vec4(ground));
          fill(in, {left, 0, right, kHeight}, -circle, vec4(object));
          each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
            const std::string which = name + ", " + std::to_string(right - left) + " wide, " + std::to_string(object) +
                                      ", circles " + std::to_string(circle) + " and " + std::to_string(behind);
            for (std::uint32_t x = 0; x < kWidth; ++x) {
              const double alpha = static_cast<double>((result.light[drawn.at(x, 48)].x - ground) / (object - ground));
              const double expected = aperture_beyond(drawn.bokeh, left - (x + 0.5), double{circle}) -
                                      aperture_beyond(drawn.bokeh, right - (x + 0.5), double{circle});
              EXPECT_NEAR(alpha, expected, 0.08) << which << " " << x;
            }
          });
        }
}

// A slope that passes through the focus keeps its light, and an object before it adds its own only.
TEST_P(DofLayersTest, near_layers_keep_the_mean_light_of_a_textured_ground) {
  DofInput in(kWidth, kHeight, 0.0f);
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      in.coc[in.at(x, y)] = 2.0f - 0.1f * static_cast<float>(y);
      in.light[in.at(x, y)] = vec4((x / 2 + y / 2) % 2 == 0 ? 1.5f : 0.5f);
    }
  each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
    for (std::uint32_t y = 24; y + 24 < kHeight; y += 4) {
      double sum = 0.0;
      for (std::uint32_t v = y; v < y + 4; ++v)
        for (std::uint32_t x = 16; x < kWidth - 16; ++x) sum += static_cast<double>(result.light[drawn.at(x, v)].x);
      EXPECT_NEAR(sum / (4.0 * (kWidth - 32)), 1.0, 0.02) << name << ", row " << y;
    }
  });
}

// Texels that were not written are NaN (add_nan_pass()). Circles of more than 16 pixels reach over two tiles.
TEST_P(DofLayersTest, kernels_read_no_texel_that_was_not_written) {
  for (const float circle : {30.0f, 10.0f, -10.0f, -30.0f}) {
    DofInput in(400, 300, 0.0f, vec4(0.5f));
    in.knobs.radius = 31.0f;
    fill(in, {190, 140, 205, 155}, circle, vec4(0.5f));
    each_kernel(in, [&](const DofResult& result, const DofInput&, const std::string& name) {
      std::size_t wrong = 0;
      for (const vec4& light : result.light) wrong += std::abs(light.x - 0.5f) < 3e-3f ? 0 : 1;
      EXPECT_EQ(wrong, 0u) << name << ", circle " << circle;
    });
  }
}

// Hard case: dof.nan_light, dof.infinite_light
TEST_P(DofLayersTest, light_that_is_not_finite_does_not_spread_and_stays_in_focus_only) {
  for (const float bad : {std::nanf(""), kInfinity, -kInfinity})
    for (const std::uint32_t side : {1u, 2u, 5u}) {
      DofInput in(kWidth, kHeight, 10.0f, vec4(0.5f));
      fill(in, {0, 48, 64, kHeight}, 0.0f, vec4(0.5f));
      fill(in, {64, 48, kWidth, kHeight}, -10.0f, vec4(0.5f));
      fill(in, {30, 20, 30 + side, 20 + side}, 10.0f, vec4(bad));
      fill(in, {21, 75, 21 + side, 75 + side}, 0.0f, vec4(bad));
      fill(in, {100, 75, 100 + side, 75 + side}, -10.0f, vec4(bad));
      each_kernel(in, [&](const DofResult& result, const DofInput& drawn, const std::string& name) {
        std::size_t wrong = 0, first = 0;
        for (std::size_t i = 0; i < result.light.size(); ++i) {
          const bool bad_here = !is_finite(drawn.light[i]);
          const float light = result.light[i].x;
          // Where it was blurred, there may be a dark place.
          const bool right = bad_here && drawn.coc[i] == 0.0f ? result.halves[i] == dof_half(drawn.light[i])
                             : bad_here                       ? light >= 0.0f && light < 0.505f
                                                              : std::abs(light - 0.5f) < 5e-3f;
          if (!right && wrong++ == 0) first = i;
        }
        EXPECT_EQ(wrong, 0u) << bad << ", side " << side << ", " << name << ": first " << first % kWidth << ", "
                             << first / kWidth << " = " << result.light[first].x;
      });
    }
}

TEST_P(DofLayersTest, a_blurred_picture_without_finite_light_is_black) {
  for (const float circle : {10.0f, -10.0f})
    each_kernel(DofInput(40, 30, circle, vec4(std::nanf(""))),
                [&](const DofResult& result, const DofInput&, const std::string& name) {
                  std::size_t wrong = 0;
                  for (const DofHalf& light : result.halves) wrong += light[0] == 0 ? 0 : 1;
                  EXPECT_EQ(wrong, 0u) << name << ", circle " << circle;
                });
}

TEST_P(DofLayersTest, the_brightest_light_stays_finite) {
  for (const float circle : {10.0f, 1.0f, -1.0f, -10.0f})
    each_kernel(DofInput(70, 50, circle, vec4(65504.0f)),
                [&](const DofResult& result, const DofInput&, const std::string& name) {
                  for (const vec4& light : result.light) ASSERT_NEAR(light.x, 65504.0f, 65504.0f * 3e-3f) << name;
                });
}

}  // namespace
}  // namespace gloam::test
