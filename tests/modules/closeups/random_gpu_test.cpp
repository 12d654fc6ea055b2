// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/modules/closeups/scene.h"

namespace gloam::test {
namespace {

using CloseupRandom = CloseupScene;

// Random scenes: finite, lists in order, and the same with and without close-up maps.
TEST_F(CloseupRandom, random_scenes_are_alike_with_and_without_closeups) {
  SeenDifference sum;
  double pairs = 0.0;
  for (std::uint32_t seed = 1; seed <= static_cast<std::uint32_t>(scaled(10)); ++seed) {
    const std::string what = "seed " + std::to_string(seed);
    random_scene(seed, 96, 64);
    Dice dice(seed + 1000);
    for (const Entity lamp : lamps) world.get<ShadowCaster>(lamp).resolution = 256;
    set("shadows.atlas", "2048");
    std::size_t subjects = 0;
    for (const Entity thing : things) {
      if (!world.has<MeshInstance>(thing) || subjects == 4 || !dice.one_in(3)) continue;
      world.add(thing, CloseupSubject{true, static_cast<float>(dice.between(0.0, 2.0))});
      ++subjects;
    }
    set("closeups.max_pairs", "256");
    set("closeups.batch", dice.one_of({"1", "2", "4"}));
    const CloseupShot with = second_shot();
    pairs += counted("closeups.pairs");
    expect_slots_are_one_entrys(with.lists, what);
    expect_fallback_listed_once(with.lists, what);
    expect_finite_maps(what);
    set("closeups.max_pairs", "0");
    const CloseupShot off = second_shot();
    SeenDifference apart;
    for (const Entity lamp : lamps) {
      if (!world.get<ShadowCaster>(lamp).enabled) continue;
      const SeenLight a = seen(with.lists, lamp), b = seen(off.lists, lamp);
      for (std::size_t i = 0; i < a.pixels.size(); ++i)
        if (gives(with.geometry, i, lamp)) apart.add(a.pixels[i], b.pixels[i]), sum.add(a.pixels[i], b.pixels[i]);
    }
    EXPECT_LE(apart.mean(), 0.04) << what;
    EXPECT_LE(apart.half_share(), 0.03) << what;
    if (HasFatalFailure()) return;
  }
  std::printf("%.0f pairs, %zu pixels: mean %.4f, opposite %.4f\n", pairs, sum.pixels, sum.mean(), sum.half_share());
  EXPECT_GT(pairs, 15.0);
  EXPECT_LE(sum.mean(), 0.01);
  EXPECT_LE(sum.half_share(), 0.005);
}

}  // namespace
}  // namespace gloam::test
