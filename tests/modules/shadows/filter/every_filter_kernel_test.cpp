// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/rig.h"

namespace gloam::test {
namespace {

using shaders::ShadowProbe;

class EveryShadowFilter : public ShadowKernelTest {};

// No filter is half a texel off: on the line between lit and blocked texels, half of the light arrives.
TEST_F(EveryShadowFilter, the_middle_of_an_edge_is_half_lit) {
  SpotRig rig;
  for (const bool upright : {false, true}) {
    const auto depths = over_floor(rig.size, [&](std::uint32_t x, std::uint32_t y) { return (upright ? x : y) < 120; });
    for (const std::uint32_t kernel : {4u, 8u, 12u, 16u}) {
      for (const std::uint32_t filter : {1u, 2u, 3u}) {
        const double at = 120.0;
        std::vector<ShadowProbe> probes;
        for (int i = 0; i < 16; ++i)
          probes.push_back(rig.at(upright ? floor_at(rig, at, 100.0 + i * 0.31) : floor_at(rig, 100.0 + i * 0.31, at)));
        rig.width_m = filter == 3 ? 0.0 : rig.width_for(7.0, 4.0, 2.0);
        for (const auto& result : rig.look(device(), depths, probes, {.filter = filter, .kernel = kernel}))
          EXPECT_NEAR(result.visibility, 0.5, filter == 2 ? 0.15 : 2e-3) << "filter " << filter << " kernel " << kernel;
      }
    }
  }
}

TEST_F(EveryShadowFilter, no_blocker_is_lit_and_all_blocked_is_dark_with_every_filter) {
  SpotRig rig;
  rig.width_m = 0.4;
  const auto open = over_floor(rig.size, [](std::uint32_t, std::uint32_t) { return false; });
  const auto closed = over_floor(rig.size, [](std::uint32_t, std::uint32_t) { return true; });
  std::vector<float> empty(open.size(), 0.0f);
  std::vector<ShadowProbe> probes;
  for (int i = 0; i < 256; ++i) probes.push_back(rig.at(floor_at(rig, 15.0 + (i % 16) * 15.0, 15.0 + (i / 16) * 15.0)));
  for (ProbeSettings settings : every_filter()) {
    // Each setting is a pipeline to compile. Only filter 3 has early-outs to switch off.
    for (std::uint32_t full = 0; full <= (settings.filter == 3 ? 1u : 0u); ++full) {
      settings.full_penumbra = full;
      for (const auto& result : rig.look(device(), open, probes, settings))
        ASSERT_EQ(result.visibility, 1.0f) << name_of(settings);
      for (const auto& result : rig.look(device(), empty, probes, settings))
        ASSERT_EQ(result.visibility, 1.0f) << name_of(settings);
      for (const auto& result : rig.look(device(), closed, probes, settings))
        ASSERT_NEAR(result.visibility, 0.0f, 1e-4f) << name_of(settings);
    }
  }
}

}  // namespace
}  // namespace gloam::test
