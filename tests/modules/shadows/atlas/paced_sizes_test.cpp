// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/paced_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace gloam {
namespace {

constexpr std::uint64_t kRoom = 4096ull * 4096;

/// Frames until nothing waits, with the sizes of each frame held in the next. Expects that each frame draws at most its
/// share or one light, and that held and new squares always fit.
std::size_t frames_until_done(std::vector<PacedLight> lights, bool fill) {
  std::uint64_t wanted = 0;
  for (const PacedLight& light : lights) wanted += std::uint64_t{light.faces} * light.wanted * light.wanted;
  for (std::size_t frame = 1; frame < 1000; ++frame) {
    const std::uint32_t waiting = pace_sizes(lights, kRoom, fill);
    std::uint64_t drawn = 0, placed = 0, changes = 0;
    for (PacedLight& light : lights) {
      EXPECT_TRUE(light.size == light.wanted || light.size == light.held);
      placed += std::uint64_t{light.faces} * light.size * light.size;
      if (light.size == light.held) continue;
      ++changes;
      drawn += std::uint64_t{light.faces} * light.size * light.size;
      light.held = light.size;
    }
    EXPECT_TRUE(changes == 1 || drawn <= wanted / kPacedFrames) << frame;
    EXPECT_LE(placed, kRoom) << frame;
    if (waiting == 0) return frame;
    EXPECT_GT(changes, 0u) << "a frame in which nothing changes, while faces wait";
    if (changes == 0) break;
  }
  return 0;
}

TEST(PacedSizes, spread_a_change_over_frames) {
  const std::vector<PacedLight> lights(60, {.faces = 6, .held = 128, .wanted = 64, .importance = 1.0f});
  EXPECT_EQ(frames_until_done(lights, false), 12u);
}

TEST(PacedSizes, let_one_light_change_that_is_larger_than_its_share) {
  std::vector<PacedLight> lights(3, {.faces = 6, .held = 256, .wanted = 512, .importance = 1.0f});
  lights[1].importance = 2.0f;
  EXPECT_EQ(pace_sizes(lights, kRoom, false), 12u);
  EXPECT_EQ(lights[1].size, 512u) << "the most important one";
  EXPECT_EQ(lights[0].size, 256u);
  EXPECT_EQ(frames_until_done(lights, false), 3u);
}

TEST(PacedSizes, never_want_more_room_than_there_is_while_lights_swap_sizes) {
  // Each half of the lights takes what the other half gives back.
  std::vector<PacedLight> lights(16, {.faces = 6, .held = 256, .wanted = 512, .importance = 9.0f});
  for (std::size_t i = 0; i < 8; ++i) lights[i] = {.faces = 6, .held = 512, .wanted = 256, .importance = 0.1f};
  EXPECT_GT(frames_until_done(lights, false), 3u);
}

TEST(PacedSizes, give_new_lights_their_maps_at_once_unless_shadows_are_switched_on) {
  std::vector<PacedLight> lights(24, {.faces = 1, .held = 0, .wanted = 256, .importance = 1.0f});
  EXPECT_EQ(pace_sizes(lights, kRoom, false), 0u);
  EXPECT_TRUE(std::ranges::all_of(lights, [](const PacedLight& light) { return light.size == 256; }));
  EXPECT_EQ(pace_sizes(lights, kRoom, true), 22u);
  EXPECT_EQ(lights[2].size, 0u);
  EXPECT_EQ(frames_until_done(lights, true), 12u);
}

TEST(PacedSizes, leave_lights_without_faces_and_full_atlases_alone) {
  std::vector<PacedLight> lights = {{.faces = 0, .held = 0, .wanted = 0, .importance = 1.0f}};
  EXPECT_EQ(pace_sizes(lights, kRoom, true), 0u);
  EXPECT_EQ(lights[0].size, 0u);
  EXPECT_EQ(pace_sizes({}, kRoom, false), 0u);
  // More than fits: which lights get less is not for this function to say, so none waits for ever.
  std::vector<PacedLight> many(100, {.faces = 6, .held = 256, .wanted = 512, .importance = 1.0f});
  EXPECT_EQ(pace_sizes(many, kRoom, false), 0u);
  EXPECT_EQ(many[99].size, 512u);
}

}  // namespace
}  // namespace gloam
