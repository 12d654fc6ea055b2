// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>

#include "modules/reflections/culling/tiles.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

using test::ProxyRandom;

/// A camera in or around a place that is `scale` metres large, whose ground is at y = 0 before `offset` is added.
RenderView draw_view(ProxyRandom& random, double scale, const dvec3& offset) {
  static constexpr uvec2 kSizes[] = {{1, 1}, {7, 5}, {33, 31}, {97, 500}, {320, 180}, {640, 360}, {1001, 333}};
  ViewSettings settings;
  const uvec2 size = kSizes[random.index(7)];
  settings.width = size.x;
  settings.height = size.y;
  const double height = random.one_in(6) ? random.between(-0.2, 3.0) : random.between(0.02, 0.4);
  const dvec3 eye = offset + scale * dvec3(random.between(-0.5, 0.5), height, random.between(-0.5, 0.5));
  dmat4 pose = glm::rotate(glm::translate(dmat4(1.0), eye), random.between(-3.2, 3.2), dvec3(0.0, 1.0, 0.0));
  static constexpr double kDown = -1.5707963267948966;
  const double pitches[] = {0.0, kDown, -kDown, kDown + 1e-4, -0.3, -0.8};
  pose = glm::rotate(pose, random.one_in(3) ? pitches[random.index(6)] : random.between(-1.6, 0.4), dvec3(1, 0, 0));
  if (random.one_in(3)) pose = glm::rotate(pose, random.between(-3.2, 3.2), dvec3(0, 0, 1));
  settings.world_from_camera = pose;
  settings.camera.orthographic = random.one_in(5);
  settings.camera.half_height_m = static_cast<float>(scale * random.length(-1.5, 0.5));
  settings.camera.near_m = static_cast<float>(scale * random.length(-4.0, -0.7));
  settings.camera.fov_y = static_cast<float>(random.one_in(3) ? random.between(0.05, 2.9) : 1.0);
  if (random.one_in(10))
    settings.mirror = MirrorPlane{glm::normalize(dvec3(1.0, 0.0, 0.3)), random.between(-1.0, 1.0) * scale};
  RenderView view = make_view(settings, 0);
  if (random.one_in(5)) {
    const int column = view.camera.orthographic ? 3 : 2;
    view.clip_from_view[column][0] = static_cast<float>(random.between(-1.5, 1.5));
    view.clip_from_view[column][1] = static_cast<float>(random.between(-1.5, 1.5));
    view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  }
  return view;
}

dvec3 draw_facing(ProxyRandom& random) {
  switch (random.index(6)) {
    case 0:
      return {0.0, -1.0, 0.0};
    case 1:
      return {0.0, 1.0, 0.0};
    case 2:
      return random.direction();
    default: {
      const double turn = random.between(-3.2, 3.2);
      return {std::cos(turn), 0.0, std::sin(turn)};
    }
  }
}

void draw_proxies(ProxyRandom& random, int count, double scale, const dvec3& offset, const RenderView& view,
                  test::ProxyScene& scene) {
  for (int i = 0; i < count; ++i) {
    const double reach = random.one_in(4) ? 0.05 : 0.7;  // some close to the camera, across its near plane
    dvec3 center = random.one_in(3) ? view.position : offset;
    center += scale * dvec3(random.between(-reach, reach), random.between(-0.1, 0.6), random.between(-reach, reach));
    const double size = scale * (random.one_in(6) ? random.length(-0.5, 1.3) : random.length(-2.0, 0.0));
    const double aspect = random.length(-0.7, 0.7);
    test::SceneProxy& proxy =
        scene.add(center, draw_facing(random), {static_cast<float>(size), static_cast<float>(size * aspect)});
    if (random.one_in(5))
      proxy.world_from_node = glm::scale(proxy.world_from_node, random.inside(dvec3(2.0)) + dvec3(0.01));
    if (random.one_in(8)) proxy.world_from_node[1] += 0.5 * proxy.world_from_node[0];  // sheared
  }
}

void draw_rooms(ProxyRandom& random, double scale, const dvec3& offset, test::ProxyScene& scene) {
  for (int i = random.one_in(3) ? 0 : random.index(4); i > 0; --i) {
    const vec3 size(scale * dvec3(random.between(0.5, 2.0), random.between(0.4, 2.0), random.between(0.5, 2.0)));
    const dvec3 center = offset + scale * dvec3(random.between(-0.3, 0.3), 0.0, random.between(-0.3, 0.3));
    test::SceneRoom& room =
        scene.add_room(center + dvec3(0.0, 0.5 * static_cast<double>(size.y) - 0.1 * scale, 0.0), size);
    if (random.one_in(3))
      room.world_from_node = glm::rotate(room.world_from_node, random.between(-3.2, 3.2), random.direction());
    if (!random.one_in(4)) continue;
    room.heights = ReflectingHeights{};
    for (float& height : room.heights->heights_m)
      height = static_cast<float>(offset.y + scale * random.between(-0.1, 0.4));
    room.heights->count = static_cast<std::uint32_t>(random.index(5));
  }
}

// Hard case: selftest.proxy_tiles
TEST(ProxyTilesRandom, never_miss_a_proxy_that_a_reflected_ray_hits) {
  test::HitCount count;
  std::uint64_t listed = 0;
  std::uint64_t all = 0;
  const int views = test::scaled(10'000);
  for (int n = 0; n < views; ++n) {
    ProxyRandom random(static_cast<std::uint32_t>(n));
    const double scale = random.length(-0.5, 2.0);
    const dvec3 offset = random.one_in(3) ? 1e4 * random.inside(dvec3(1.0)) : dvec3(0.0);
    const RenderView view = draw_view(random, scale, offset);
    test::ProxyScene scene;
    draw_proxies(random, 1 + random.index(6), scale, offset, view, scene);
    draw_rooms(random, scale, offset, scene);
    ProxyTileSettings settings;
    static constexpr std::uint32_t kTiles[] = {1, 4, 8, 16, 32, 64};
    settings.tiles = kTiles[random.index(6)];
    settings.columns = random.one_in(2) ? 0 : view.width;
    const ProxyTiles tiles = test::build(scene, view, settings);
    std::vector<double> heights;
    double lowest = offset.y - (random.one_in(2) ? 0.0 : 0.1 * scale);
    for (const test::SceneRoom& room : scene.rooms) {
      if (random.one_in(2)) lowest = room.floor();
      if (!room.heights || random.one_in(2)) continue;
      for (std::uint32_t h = 0; h < room.heights->count; ++h)
        heights.push_back(static_cast<double>(room.heights->heights_m[h]));
    }
    const std::uint64_t missed = count.missed;
    test::try_pixels(scene, view, tiles, 200, lowest, heights, random, count);
    EXPECT_EQ(count.missed, missed) << "view " << n;
    all += scene.proxies.size() * tiles.tiles;
    for (const std::uint32_t word : tiles.masks) listed += static_cast<std::uint64_t>(std::popcount(word));
    if (HasFailure() && count.missed > 20) break;
  }
  RecordProperty("hits", std::to_string(count.hits));
  RecordProperty("share", std::to_string(static_cast<double>(listed) / static_cast<double>(all)));
  EXPECT_GT(count.hits, static_cast<std::uint64_t>(views) * 10);
  EXPECT_LT(static_cast<double>(listed), 0.11 * static_cast<double>(all)) << "random views look at few proxies";
}

}  // namespace
}  // namespace gloam
