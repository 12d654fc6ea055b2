// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/rig.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

class ShadowFilter : public ShadowKernelTest {};

// Bars one texel of the tested mip wide, and a penumbra that only this mip filters: in its texels, half as wide as the
// kernel.
// Hard case: shadows.bars
TEST_F(ShadowFilter, bars_of_one_texel_give_half_the_light_at_every_mip) {
  for (const ProbeSettings settings :
       {ProbeSettings{}, ProbeSettings{.shape = 1}, ProbeSettings{.kernel = 12}, ProbeSettings{.kernel = 16}}) {
    for (std::uint32_t mip = 0; mip <= (settings.kernel == 8 ? 5u : 4u); ++mip) {
      for (const bool upright : {false, true}) {
        SpotRig rig;
        rig.size = 512;
        rig.width_m = rig.width_for(0.5 * settings.kernel * (1u << mip), 4.0, 2.0);
        const auto depths = over_floor(
            rig.size, [&](std::uint32_t x, std::uint32_t y) { return ((upright ? x : y) >> mip & 1u) != 0; });
        std::vector<ShadowProbe> probes;
        for (int i = 0; i < 64; ++i)
          probes.push_back(
              rig.at(floor_at(rig, 256.0 + (i % 8) * 0.26 * (1u << mip), 256.0 + (i / 8) * 0.29 * (1u << mip))));
        double sum = 0.0;
        for (const auto& result : rig.look(device(), depths, probes, settings)) {
          EXPECT_NEAR(result.visibility, 0.5, 0.05) << name_of(settings) << " mip " << mip;
          sum += result.visibility / 64.0;
        }
        EXPECT_NEAR(sum, 0.5, 0.02);
      }
    }
  }
}

// Hard case: shadows.bars
TEST_F(ShadowFilter, finest_bars_give_half_the_light_at_every_mip_that_knows_its_coverage) {
  for (const ProbeSettings settings : {ProbeSettings{.coverage = 1}, ProbeSettings{.kernel = 12, .coverage = 1}}) {
    for (std::uint32_t mip = 0; mip <= 4; ++mip) {
      SpotRig rig;
      rig.size = 512;
      rig.width_m = rig.width_for(0.5 * settings.kernel * (1u << mip), 4.0, 2.0);
      const auto depths = over_floor(rig.size, [](std::uint32_t x, std::uint32_t) { return (x & 1u) != 0; });
      std::vector<ShadowProbe> probes;
      for (int i = 0; i < 64; ++i)
        probes.push_back(
            rig.at(floor_at(rig, 256.0 + (i % 8) * 0.26 * (1u << mip), 256.0 + (i / 8) * 0.29 * (1u << mip))));
      for (const auto& result : rig.look(device(), depths, probes, settings))
        EXPECT_NEAR(result.visibility, 0.5, 0.05) << name_of(settings) << " mip " << mip;
    }
  }
}

TEST_F(ShadowFilter, wide_shadows_do_not_grow_where_mips_know_their_coverage) {
  double nearest = 0.0, covered = 0.0;
  for (const double edge : {256.0, 257.0, 259.0, 263.0, 270.0}) {  // at any position in a mip's texel
    SpotRig rig;
    rig.size = 512;
    rig.width_m = rig.width_for(90.0, 4.0, 2.0);
    const auto depths = over_floor(rig.size, [&](std::uint32_t x, std::uint32_t) { return x < edge; });
    const std::vector<ShadowProbe> probes = {rig.at(floor_at(rig, edge, 256.0))};
    nearest += rig.look(device(), depths, probes, {})[0].visibility / 5.0;
    const float half = rig.look(device(), depths, probes, {.coverage = 1})[0].visibility;
    EXPECT_NEAR(half, 0.5f, 0.06f) << "edge at " << edge;
    covered += static_cast<double>(half) / 5.0;
  }
  EXPECT_NEAR(covered, 0.5, 0.03);
  EXPECT_LT(nearest, 0.45) << "what coverage is there for";
}

/// Number of texels of a row or column, of the N around a receiver, whose middles are within this reach of it.
int texels_in_cone(double at, int kernel, double reach) {
  const double first = std::floor(at - 0.5) - (kernel / 2 - 1);
  int count = 0;
  for (int i = 0; i < kernel; ++i) count += std::abs(first + i + 0.5 - at) <= reach;
  return count;
}

TEST_F(ShadowFilter, the_search_counts_what_lies_in_the_cone_wherever_the_receiver_lies_in_its_texel) {
  for (const std::uint32_t kernel : {4u, 8u, 12u, 16u}) {
    SpotRig rig;
    rig.width_m = 0.3;
    std::vector<ShadowProbe> probes;
    for (int i = 0; i < 256; ++i)
      probes.push_back(rig.at(floor_at(rig, 100.0 + (i % 16) / 15.0, 90.0 + (i / 16) / 15.0)));
    const auto depths = over_floor(rig.size, [](std::uint32_t, std::uint32_t) { return true; });
    const auto results = rig.look(device(), depths, probes, {.kernel = kernel});
    for (std::size_t i = 0; i < results.size(); ++i) {
      const auto& result = results[i];
      const double region = result.region_width;
      const double texel = std::exp2(std::ceil(std::log2(std::max(region / (kernel - 1), 1.0))));
      const double reach = std::max(0.5 * region / texel, 1.5) + 0.5;
      const auto count = [&](double slack) {
        const glm::dvec2 at =
            glm::dvec2(100.0 + static_cast<double>(i % 16) / 15.0, 90.0 + static_cast<double>(i / 16) / 15.0) / texel;
        const int texels = static_cast<int>(kernel);
        return texels_in_cone(at.x, texels, reach + slack) * texels_in_cone(at.y, texels, reach + slack);
      };
      // All blockers have one depth. There the emitter is as wide as the region.
      const double share = std::pow(std::min(texel / region, 1.0), 2.0), counted = result.blocker_count / share;
      EXPECT_GE(counted, count(-0.02) - 1e-3) << "kernel " << kernel << " probe " << i;
      EXPECT_LE(counted, count(0.02) + 1e-3) << "kernel " << kernel << " probe " << i;
      EXPECT_NEAR(result.blocker_depth, 0.025f, 1e-6f);
      EXPECT_EQ(result.visibility, 0.0f);
    }
  }
}

TEST_F(ShadowFilter, the_mean_blocker_is_a_mean_of_distances_over_what_the_blockers_hide_of_the_emitter) {
  SpotRig rig;
  rig.width_m = rig.width_for(27.0, 4.0, 1.0);
  std::vector<float> depths = over_floor(rig.size, [](std::uint32_t, std::uint32_t) { return true; });
  for (std::uint32_t y = 0; y < rig.size; ++y)
    for (std::uint32_t x = 0; x < 128; ++x) depths[y * rig.size + x] = 0.05f / 1.0f;
  const std::vector<ShadowProbe> probes = {rig.at(floor_at(rig, 128.0, 128.0))};
  // At mip 0, on the border of two texels, the halves with blockers at 1 m and at 2 m are equally wide, and all of
  // their texels are in the cone. From 4 m, a texel at 1 m hides a ninth of what a texel at 2 m hides.
  EXPECT_NEAR(rig.look(device(), depths, probes, {.mips = 0})[0].blocker_depth, 0.05 / 1.9, 1e-5);
}

TEST_F(ShadowFilter, filters_of_both_shapes_are_symmetric) {
  SpotRig rig;
  rig.width_m = rig.width_for(5.0, 4.0, 2.0);
  const auto left = over_floor(rig.size, [](std::uint32_t x, std::uint32_t) { return x < 128; });
  const auto upper = over_floor(rig.size, [](std::uint32_t, std::uint32_t y) { return y < 128; });
  for (const std::uint32_t shape : {0u, 1u}) {
    std::vector<ShadowProbe> across, down;
    for (int i = -20; i <= 20; ++i) {
      across.push_back(rig.at(floor_at(rig, 128.0 + i * 0.2, 77.0)));
      down.push_back(rig.at(floor_at(rig, 77.0, 128.0 + i * 0.2)));
    }
    const auto a = rig.look(device(), left, across, {.mips = 0, .shape = shape});
    const auto b = rig.look(device(), upper, down, {.mips = 0, .shape = shape});
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_NEAR(a[i].visibility, b[i].visibility, 2e-3);
      // At the ends of the penumbra, the search may miss an edge by half a texel that the filter would find.
      const bool end = std::min(a[i].visibility, 1.0f - a[i].visibility) < 0.02f;
      EXPECT_NEAR(a[i].visibility, 1.0f - a[a.size() - 1 - i].visibility, end ? 0.02 : 4e-3);
    }
  }
}

TEST_F(ShadowFilter, the_standard_filters_own_shader_gives_the_same_to_the_bit) {
  for (const double width : {0.0, 0.02, 0.3}) {
    SpotRig rig;
    rig.width_m = width;
    const auto depths = over_floor(rig.size, [](std::uint32_t x, std::uint32_t y) {
      return (x - 130u) * (x - 130u) + (y - 120u) * (y - 120u) < 900u;
    });
    std::vector<ShadowProbe> probes;
    for (int i = 0; i < 1024; ++i)
      probes.push_back(rig.at(floor_at(rig, 60.0 + (i % 32) * 4.1, 60.0 + (i / 32) * 4.1)));
    for (const std::uint32_t coverage : {0u, 1u}) {
      const auto any = rig.look(device(), depths, probes, {.coverage = coverage});
      const auto standard = rig.look(device(), depths, probes, {.coverage = coverage, .standard = true});
      int between = 0;
      for (std::size_t i = 0; i < probes.size(); ++i) {
        EXPECT_EQ(any[i].visibility, standard[i].visibility) << "width " << width << " probe " << i;
        between += standard[i].visibility > 0.01f && standard[i].visibility < 0.99f;
      }
      EXPECT_GT(between, width > 0.1 ? 100 : 0);
    }
  }
}

TEST_F(ShadowFilter, early_outs_do_not_change_what_is_seen) {
  SpotRig rig;
  rig.width_m = 0.3;
  const auto depths = over_floor(rig.size, [](std::uint32_t x, std::uint32_t y) {
    return (x - 130u) * (x - 130u) + (y - 120u) * (y - 120u) < 900u;
  });
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 1024; ++i) probes.push_back(rig.at(floor_at(rig, 60.0 + (i % 32) * 4.1, 60.0 + (i / 32) * 4.1)));
  const auto fast = rig.look(device(), depths, probes, {});
  const auto full = rig.look(device(), depths, probes, {.full_penumbra = 1});
  for (std::size_t i = 0; i < probes.size(); ++i) EXPECT_NEAR(fast[i].visibility, full[i].visibility, 0.03) << i;
}

TEST_F(ShadowFilter, visibility_has_the_steps_of_a_slot) {
  SpotRig rig;
  rig.width_m = 0.3;
  const auto depths = over_floor(rig.size, [](std::uint32_t x, std::uint32_t) { return x < 128; });
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 200; ++i) probes.push_back(rig.at(floor_at(rig, 100.0 + i * 0.3, 128.0)));
  const auto exact = rig.look(device(), depths, probes, {});
  for (const std::uint32_t levels : {15u, 255u}) {
    const auto steps = rig.look(device(), depths, probes, {.levels = levels});
    for (std::size_t i = 0; i < probes.size(); ++i) {
      EXPECT_NEAR(steps[i].visibility, exact[i].visibility, 0.5001f / static_cast<float>(levels));
      const float step = steps[i].visibility * static_cast<float>(levels);
      EXPECT_NEAR(step, std::round(step), 1e-4f);
    }
  }
}

TEST_F(ShadowFilter, a_cookie_lies_upright_in_the_cone_and_ends_in_its_border) {
  SpotRig rig;
  const std::vector<float> empty(std::size_t{rig.size} * rig.size, 0.0f);
  ShadowMaps maps(device(), rig.size);
  shaders::ShadowRow row = spot_row(rig.pose, rig.tan_inner, 0.0, uvec2(0), rig.size);
  row.cookie_tan = 0.4f;
  shaders::ShadowRow with = row;
  with.cookie_layer = 0.0f;
  std::vector<ShadowProbe> probes;
  for (const dvec3& p :
       {dvec3(0.8, 0.0, 0.0), dvec3(-0.8, 0.0, 0.0), dvec3(0.0, 0.0, 0.8), dvec3(0.0, 0.0, -0.8), dvec3(9.0, 0.0, 9.0)})
    probes.push_back(rig.at(p));
  probes.push_back(rig.at(dvec3(0.8, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), 1));
  const auto results = maps.probe(probes, {with, row}, shadow_block(maps));
  EXPECT_NEAR(results[0].cookie.x, 1.0f, 0.01f);  // red increases along the right axis
  EXPECT_NEAR(results[1].cookie.x, 0.0f, 0.01f);
  EXPECT_NEAR(results[2].cookie.y, 1.0f, 0.01f);  // green increases against the up axis
  EXPECT_NEAR(results[3].cookie.y, 0.0f, 0.01f);
  EXPECT_NEAR(results[4].cookie.x, 1.0f, 0.01f);
  EXPECT_EQ(results[5].cookie, vec2(1.0f));
}

}  // namespace
}  // namespace gloam::test
