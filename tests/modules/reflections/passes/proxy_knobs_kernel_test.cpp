// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Knobs that switch parts of the proxies' kernel off.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/modules/reflections/support/blend_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

class ProxyKnobs : public KernelTest {};

TEST_F(ProxyKnobs, without_sorting_layers_are_blended_in_the_order_of_the_proxies_after_screen_space) {
  ProxyScene scene;
  scene.add({0.0, 0.0, -9.0}, {0.0, 0.0, 1.0}, vec2(400.0f));
  scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(400.0f));
  const ProxyWorld world(scene);
  const vec4 far(1.0f, 0.0f, 0.0f, 1.0f), near(0.0f, 1.0f, 0.0f, 1.0f), screen(0.0f, 0.0f, 1.0f, 0.5f);
  const FlatLayers images(device(), 4, 1, {far, near});
  const SyntheticView seen = look({}, look_at({0.0, 1.6, 3.0}, {0.0, 0.0, -1.0}, 33, 25));
  const auto count = [&](const BlendInput& in, const vec3& color) {
    const Blended picture = blend(device(), in, world, images);
    std::size_t mirrors = 0, other = 0;
    for (std::uint32_t y = 0; y < 25; ++y)
      for (std::uint32_t x = 0; x < 33; ++x) {
        if (!is_mirror(seen, {x, y}) || seen.position(x, y).z + seen.view.position.z < -3.9) continue;
        ++mirrors;
        other += glm::length(vec3(picture.color[seen.at(x, y)]) - color) < 4e-3f ? 0 : 1;
      }
    EXPECT_GT(mirrors, 100u);
    return other;
  };
  BlendInput in = blend_input(seen);
  EXPECT_EQ(count(in, {0.0f, 1.0f, 0.0f}), 0u);
  in.sort = false;
  EXPECT_EQ(count(in, {1.0f, 0.0f, 0.0f}), 0u);
  // What screen space has met lies behind both.
  in.ssr_color.assign(seen.depth.size(), screen);
  in.ssr_distance_m.assign(seen.depth.size(), 50.0f);
  EXPECT_EQ(count(in, {0.5f, 0.0f, 0.5f}), 0u);
  in.sort = true;
  EXPECT_EQ(count(in, {0.0f, 1.0f, 0.0f}), 0u);
  in.sort = false;
  in.layers = 1;
  EXPECT_EQ(count(in, {0.0f, 0.0f, 0.5f}), 0u);
}

TEST_F(ProxyKnobs, rays_of_pixel_normals_meet_proxies_as_rays_in_double) {
  ProxyScene scene;
  std::vector<vec4> colors;
  for (int i = 0; i < 60; ++i) {
    scene.add({-6.75 + 1.5 * (i % 10), 0.5 + 1.0 * (i / 10), -3.0}, {0.0, 0.0, 1.0}, {1.4f, 0.9f});
    colors.emplace_back(static_cast<float>(i % 10) / 10.0f, static_cast<float>(i / 10) / 6.0f, 0.5f, 1.0f);
  }
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, colors);
  SyntheticView seen = look({}, look_at({0.0, 1.6, 3.0}, {0.0, 0.0, 0.0}, 61, 37));
  ProxyRandom random(41);
  for (std::size_t i = 0; i < seen.normals.size(); ++i)
    if (seen.object[i] == 0)
      seen.normals[i].x =
          pack_normal_snorm16(glm::normalize(vec3(random.between(-0.2, 0.2), 1.0, random.between(-0.2, 0.2))));
  BlendInput in = blend_input(seen);
  in.naive = true;
  in.pixel_normals = true;
  const Blended picture = blend(device(), in, world, images);
  std::size_t compared = 0, wrong = 0, shown = 0;
  for (std::uint32_t y = 0; y < 37; ++y)
    for (std::uint32_t x = 0; x < 61; ++x) {
      if (!is_mirror(seen, {x, y})) continue;
      const std::size_t texel = seen.at(x, y);
      const dvec3 from = glm::normalize(seen.ray(x, y).direction);
      const dvec3 ray = glm::reflect(from, glm::normalize(dvec3(unpack_normal_snorm16(seen.normals[texel].x))));
      if (ray.y < 0.011) continue;
      dvec4 want(0.0);
      bool decided = true;
      for (std::size_t i = 0; i < scene.proxies.size(); ++i) {
        const RayMeeting met = meet_in_double(scene.proxies[i], seen.position(x, y) + seen.view.position, ray, 4e-6);
        decided &= met.decided;
        if (met.met) want = dvec4(colors[i]);
      }
      if (!decided) continue;
      ++compared;
      shown += want.w > 0.0 ? 1 : 0;
      wrong += glm::length(dvec4(picture.color[texel]) - want) < 4e-3 ? 0 : 1;
    }
  EXPECT_EQ(wrong, 0u) << compared;
  EXPECT_GT(compared, 800u);
  EXPECT_GT(shown, 400u);
}

}  // namespace
}  // namespace gloam::test
