// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "modules/particles/bake.h"
#include "tests/modules/particles/bake/bake_scene.h"

namespace gloam {
namespace {

using test::BakeScene;
using test::WallTracer;

/// Two emitters, a lamp and a lamp with a cookie; `before` other entities come first.
void fill(BakeScene& scene, int before) {
  for (int i = 0; i < before; ++i) static_cast<void>(scene.world.create(LocalTransform{}));
  scene.add_emitter({2.0, 0.0, 0.0});
  scene.add_lamp({0.0, 0.0, 0.0});
  scene.add_emitter({4.0, 1.0, 0.0});
  scene.world.get<Light>(scene.add_lamp({-1.0, 0.0, 0.0})).cookie = 1;
}

TEST(ParticleLightBytes, name_entities_by_their_order_in_the_world) {
  const WallTracer wall(1.0);
  BakeScene baked, other;
  fill(baked, 0);
  fill(other, 5);
  const ParticleLightMaps maps = baked.bake(wall);
  const auto read = decode_particle_light(other.world, encode_particle_light(baked.world, maps));
  ASSERT_TRUE(read);
  const ParticleLightMaps expected = other.bake(wall);
  ASSERT_EQ(read->maps.size(), expected.maps.size());
  for (std::size_t i = 0; i < expected.maps.size(); ++i) {
    EXPECT_EQ(read->maps[i].emitter, expected.maps[i].emitter);
    EXPECT_EQ(read->maps[i].static_lights, expected.maps[i].static_lights);
    EXPECT_EQ(read->maps[i].lights, expected.maps[i].lights);
    EXPECT_EQ(read->maps[i].size, expected.maps[i].size);
    EXPECT_EQ(read->maps[i].light_scale, maps.maps[i].light_scale);
    EXPECT_EQ(read->maps[i].flux, maps.maps[i].flux);
    EXPECT_EQ(read->maps[i].visibility, maps.maps[i].visibility);
  }
}

TEST(ParticleLightBytes, that_are_damaged_are_refused) {
  BakeScene scene;
  fill(scene, 0);
  const std::string bytes = encode_particle_light(scene.world, scene.bake(WallTracer(1.0)));
  for (std::size_t size = 0; size < bytes.size(); size += 61)
    ASSERT_FALSE(decode_particle_light(scene.world, std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(decode_particle_light(scene.world, bytes + "x"));
  // Damage may hit texels, where every value is legal: then it is read. It must not crash.
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    for (int n = 0; n < 4; ++n) damaged[random() % (i % 2 == 0 ? 200 : damaged.size())] = static_cast<char>(random());
    if (const auto maps = decode_particle_light(scene.world, damaged)) {
      EXPECT_EQ(maps->maps.size(), 2u);
    }
  }
}

TEST(ParticleLightBytes, of_a_world_with_fewer_entities_are_refused) {
  BakeScene scene, smaller;
  fill(scene, 0);
  smaller.add_emitter({2.0, 0.0, 0.0});
  EXPECT_FALSE(decode_particle_light(smaller.world, encode_particle_light(scene.world, scene.bake(WallTracer(1.0)))));
}

}  // namespace
}  // namespace gloam
