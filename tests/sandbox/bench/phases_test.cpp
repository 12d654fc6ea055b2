// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/shadows/phases.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

PassTime pass(const char* name, const char* module, double ms = 1.0) { return {name, module, ms, 0, 0}; }

TEST(ShadowPhases, maps_and_what_is_not_about_lights_are_none) {
  EXPECT_FALSE(shadow_phase_of(pass("shadow_map_draw", "shadows")));
  EXPECT_FALSE(shadow_phase_of(pass("geometry", "engine")));
  EXPECT_FALSE(shadow_phase_of(pass("tone_map", "lighting")));
  EXPECT_TRUE(makes_shadow_maps(pass("shadow_map_mips", "shadows")));
  EXPECT_FALSE(makes_shadow_maps(pass("shadow_rows", "shadows")));
}

TEST(ShadowPhases, unknown_passes_of_lights_and_shadows_are_not_left_out) {
  EXPECT_EQ(shadow_phase_of(pass("light_texels", "lights")), ShadowPhase::prepare);
  EXPECT_EQ(shadow_phase_of(pass("something_new", "shadows")), ShadowPhase::prepare);
}

TEST(ShadowPhases, a_frame_is_added_up_by_phase) {
  FrameReport report;
  report.passes = {pass("geometry", "engine", 9.0),
                   pass("depth_bounds", "engine", 0.5),
                   pass("find_lights_approx", "lights", 1.0),
                   pass("shadow_map_draw", "shadows", 40.0),
                   pass("shadow_list_start", "shadows", 0.25),
                   pass("generate_shadows", "shadows", 4.0),
                   pass("deferred", "lighting", 2.0),
                   pass("deferred", "lighting", 0.5)};
  const PhaseTimes times = phase_times(report);
  EXPECT_DOUBLE_EQ(times.of(ShadowPhase::prepare), 0.75);
  EXPECT_DOUBLE_EQ(times.of(ShadowPhase::approx), 1.0);
  EXPECT_DOUBLE_EQ(times.of(ShadowPhase::generate), 4.0);
  EXPECT_DOUBLE_EQ(times.of(ShadowPhase::lighting), 2.5);
  EXPECT_DOUBLE_EQ(times.total(), 8.25);
}

TEST(ShadowPhases, maps_of_closeups_are_added_up_apart_from_the_phases) {
  FrameReport report;
  report.passes = {
      pass("shadow_map_draw", "shadows", 40.0),         pass("shadow_map_closeup", "closeups", 1.0),
      pass("shadow_map_closeup_mips", "closeups", 2.0), pass("shadow_map_closeup_standard", "closeups", 0.5),
      pass("closeup_compose", "closeups", 4.0),         pass("closeup_transfer", "closeups", 8.0),
      pass("shadow_overlay_copy", "shadows", 16.0)};
  EXPECT_DOUBLE_EQ(closeup_map_ms(report), 3.5);
  EXPECT_DOUBLE_EQ(phase_times(report).of(ShadowPhase::closeups), 12.0);
  EXPECT_DOUBLE_EQ(phase_times(report).total(), 28.0);
}

TEST(ShadowPhases, lists_had_room_unless_a_tile_overflowed) {
  FrameReport report;
  EXPECT_TRUE(lists_had_room(report));
  report.counters["shadows.fallback_tiles"] = 0.0;
  EXPECT_TRUE(lists_had_room(report));
  report.counters["lights.overflow_tiles"] = 1.0;
  EXPECT_FALSE(lists_had_room(report));
  EXPECT_EQ(counter_of(report, "lights.overflow_tiles"), 1.0);
  EXPECT_EQ(counter_of(report, "no.such"), 0.0);
}

TEST(ShadowPhases, the_fixed_layout_is_the_papers) {
  EXPECT_DOUBLE_EQ(fixed_visibility_bytes(3840, 2160), 129600.0 * 32 * 64);  // 253 MiB
  EXPECT_NEAR(fixed_list_bytes(3840, 2160), 22.1e6, 0.05e6);
  EXPECT_DOUBLE_EQ(fixed_visibility_bytes(9, 8), 2.0 * 32 * 64);
}

}  // namespace
}  // namespace gloam
