// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/fire_quads.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "engine/math/packing.h"
#include "engine/scene/components.h"
#include "modules/reflections/captures.h"
#include "modules/reflections/components.h"

namespace gloam {
namespace {

/// Two fires and, between them, a proxy of the scene. Each texel of mip 0 is (layer, column, row, 1).
struct Fires : testing::Test {
  Fires() {
    world.register_component<IbrProxy>();
    world.register_component<WorldTransform>();
    ReflectionCaptures captures;
    captures.content = 1;
    captures.proxies = {.side = 4, .mips = 3, .count = 3, .texels = {}};
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      const dmat4 place = glm::translate(dmat4(1.0), dvec3(layer, 2.0, 0.0));
      captures.proxy_entities.push_back(world.create(
          WorldTransform{glm::rotate(place, 1.57079632679489661923, dvec3(0.0, 1.0, 0.0))},
          IbrProxy{.size_m = {0.5f, 3.0f}, .kind = layer == 1 ? IbrProxyKind::scene : IbrProxyKind::fire}));
      for (std::uint32_t texel = 0; texel < 16 + 4 + 1; ++texel)
        for (const float value :
             {static_cast<float>(layer), static_cast<float>(texel % 4), static_cast<float>(texel / 4), 1.0f})
          captures.proxies.texels.push_back(float_to_half(value));
    }
    world.set_resource(std::move(captures));
  }
  World world;
};

TEST_F(Fires, become_quads_with_the_full_image_of_their_layer) {
  FireQuads gathered = gather_fire_quads(world);
  const FireQuads fires = std::move(gathered);
  ASSERT_EQ(fires.quads.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const EmissiveQuad& quad = fires.quads[i];
    EXPECT_EQ(quad.center, dvec3(2.0 * static_cast<double>(i), 2.0, 0.0));
    EXPECT_LT(glm::length(quad.half_u - dvec3(0.0, 0.0, -0.25)), 1e-9);
    EXPECT_LT(glm::length(quad.half_v - dvec3(0.0, 1.5, 0.0)), 1e-9);
    ASSERT_EQ(quad.rgba.size(), 16u);
    EXPECT_EQ(quad.rgba[7], vec4(2.0f * static_cast<float>(i), 3.0f, 1.0f, 1.0f));
    EXPECT_EQ(quad.radiance, 1.0f);
  }
}

TEST_F(Fires, dim_with_their_lights_and_go_out) {
  const FireQuads fires = gather_fire_quads(world, [](std::uint32_t layer) { return layer == 0 ? 0.0f : 0.25f; });
  ASSERT_EQ(fires.quads.size(), 1u);
  EXPECT_EQ(fires.quads[0].center.x, 2.0);
  EXPECT_EQ(fires.quads[0].radiance, 0.25f);
  EXPECT_EQ(fires.quads[0].opacity, 0.25f);
  const FireQuads blazing = gather_fire_quads(world, [](std::uint32_t) { return 3.0f; });
  EXPECT_EQ(blazing.quads[1].radiance, 3.0f);
  EXPECT_EQ(blazing.quads[1].opacity, 1.0f);
}

TEST_F(Fires, are_none_in_a_world_without_captures) {
  world.remove_resource<ReflectionCaptures>();
  EXPECT_TRUE(gather_fire_quads(world).quads.empty());
}

}  // namespace
}  // namespace gloam
