// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/reflections/support/blend_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

/// Relative error of a receiver that is reconstructed from its depth, and of its mirrored ray: some 16 roundings.
constexpr double kRayError = 16.0 / 16777216.0;
constexpr double kDown = -1.57079632679489661923;

/// A camera in a scene with proxies.
struct ProxyCase {
  std::string name;
  ProxyScene proxies;
  SyntheticScene surfaces;
  ViewSettings camera;
};

[[nodiscard]] ViewSettings turned(const dvec3& eye, double yaw, double pitch, std::uint32_t width = 61,
                                  std::uint32_t height = 37) {
  ViewSettings settings;
  settings.width = width, settings.height = height;
  const dmat4 stand = glm::rotate(glm::translate(dmat4(1.0), eye), yaw, dvec3(0.0, 1.0, 0.0));
  settings.world_from_camera = glm::rotate(stand, pitch, dvec3(1.0, 0.0, 0.0));
  return settings;
}

/// The hard cases, one each.
[[nodiscard]] std::vector<ProxyCase> hard_cases() {
  std::vector<ProxyCase> cases;
  ProxyRandom random(31);
  const ProxyScene many = random_proxies(random, 40);
  const auto add = [&](const std::string& name, const ProxyScene& proxies, const ViewSettings& camera) {
    cases.push_back({name, proxies, {}, camera});
  };
  add("usual view", many, turned({0.0, 1.6, 6.0}, 0.1, -0.2));
  add("straight down", many, turned({0.0, 3.0, 0.0}, 0.3, kDown));
  add("straight up", many, turned({0.0, 1.0, 0.0}, 0.3, -kDown));
  add("camera on the plane", many, turned({0.0, 0.0, 6.0}, 0.0, -0.1));
  add("camera just above the plane", many, turned({0.0, 0.002, 6.0}, 0.0, -0.05));
  add("7 by 5", many, turned({0.0, 1.6, 6.0}, 0.1, -0.2, 7, 5));
  add("1 by 1", many, turned({0.0, 1.6, 6.0}, 0.1, -0.4, 1, 1));
  ViewSettings flat = turned({0.0, 4.0, 6.0}, 0.2, -0.5);
  flat.camera.orthographic = true;
  flat.camera.half_height_m = 4.0f;
  add("orthographic", many, flat);
  ViewSettings wide = turned({0.0, 1.6, 2.0}, 0.0, -0.6);
  wide.camera.fov_y = 2.4f;
  add("wide lens", many, wide);

  ProxyScene edge;
  edge.add({0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, vec2(3.0f));  // in the plane of the camera
  edge.add({0.5, 1.0, -2.0}, {-1.0, 0.0, 1e-7}, vec2(3.0f));
  edge.add({0.0, 1.6, -2.0}, {0.0, -1.0, 0.0}, vec2(3.0f));  // horizontal, at the height of the eye
  edge.add({0.0, 3.0, -3.0}, {0.0, -1.0, 0.0}, vec2(6.0f));  // a ceiling
  edge.add({0.0, 0.0, -3.0}, {0.0, 1.0, 0.0}, vec2(6.0f));   // in the floor
  add("edge-on and horizontal", edge, turned({0.0, 1.6, 5.0}, 0.0, -0.2));
  add("edge-on, pitched down", edge, turned({0.0, 1.6, 1.0}, 0.0, -1.1));

  ProxyScene near;
  near.add({0.0, 1.5, 5.95}, {0.3, -0.2, 1.0}, vec2(0.4f));         // crosses the near plane
  near.add({0.0, 1.0, 9.0}, {0.0, 0.0, -1.0}, {6.0f, 3.0f});        // behind the camera, faces it
  near.add({0.0, 1.0, 9.0}, {0.0, 0.0, 1.0}, {6.0f, 3.0f});         // behind the camera, faces away
  near.add({0.0, 20.0, -30.0}, {0.0, -0.1, 1.0}, {400.0f, 80.0f});  // larger than the screen
  near.add({3.0, 2.0, 5.0}, {-1.0, 0.0, 0.2}, {30.0f, 8.0f});       // from far ahead to far behind
  add("near plane", near, turned({0.0, 1.5, 6.0}, 0.0, -0.25));
  add("near plane, looking down", near, turned({0.0, 1.5, 6.0}, 0.0, -1.3));

  ProxyScene rooms = many;
  rooms.add_room({0.0, 2.5, 0.0}, {8.0f, 5.0f, 12.0f});
  rooms.add_room({0.0, 2.5, 1.0}, {4.0f, 5.0f, 4.0f});    // nested
  rooms.add_room({4.0, 2.5, 0.0}, {8.0f, 5.0f, 12.0f});   // overlaps
  rooms.add_room({-8.0, 2.5, 0.0}, {8.0f, 5.0f, 12.0f});  // touches the first at x = −4
  for (const dvec3& eye :
       {dvec3(-1.0, 1.6, 5.0), dvec3(0.5, 1.6, 2.0), dvec3(3.0, 1.6, 5.0), dvec3(-4.0, 1.6, 4.0), dvec3(0.0, 1.6, 7.9)})
    add("rooms, camera at " + std::to_string(eye.x) + ", " + std::to_string(eye.z), rooms, turned(eye, 0.0, -0.3));

  ProxyScene heights = many;
  heights.add_room({0.0, 4.0, 0.0}, vec3(30.0f)).heights = ReflectingHeights{{0.0f, 2.0f}, 2};
  ProxyCase street{"street and roof", heights, {}, turned({0.0, 3.2, 6.0}, 0.0, -0.5)};
  street.surfaces.boxes.push_back({{-6.0, 0.0, -6.0}, {0.0, 2.0, 2.0}, 0xFFFF0000u});
  cases.push_back(street);
  ProxyCase roof = street;
  roof.name = "a roof that is no reflecting height";
  roof.proxies.rooms[0].heights = ReflectingHeights{{0.0f, 1.0f}, 2};
  cases.push_back(roof);
  ProxyCase bands = street;
  bands.name = "six heights of two rooms";
  bands.proxies.rooms.clear();
  bands.proxies.add_room({0.0, 4.0, 0.0}, vec3(30.0f)).heights = ReflectingHeights{{0.0f, 0.4f, 0.8f, 1.2f}, 4};
  bands.proxies.add_room({0.0, 4.0, 0.0}, vec3(31.0f)).heights = ReflectingHeights{{1.6f, 2.4f}, 2};
  cases.push_back(bands);
  return cases;
}

class ProxyBlend : public KernelTest {
 protected:
  /// A layer for each proxy: opaque, transparent and empty ones, all different.
  [[nodiscard]] static std::vector<vec4> colors_of(std::size_t count) {
    std::vector<vec4> colors;
    for (std::size_t i = 0; i < std::max<std::size_t>(count, 1); ++i) {
      const float alpha = i % 4 == 3 ? 0.0f : i % 4 == 2 ? 0.25f : i % 4 == 1 ? 0.75f : 1.0f;
      colors.push_back(alpha * vec4(static_cast<float>(i % 7) / 8.0f + 0.125f, static_cast<float>(i % 5) / 4.0f,
                                    static_cast<float>(i % 11) / 16.0f, 1.0f));
    }
    return colors;
  }

  static void expect_same(const Blended& a, const Blended& b, const std::string& what) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i)
      different += a.color[i] != b.color[i] || a.surface[i] != b.surface[i] ? 1 : 0;
    EXPECT_EQ(different, 0u) << what << ": of " << a.color.size() << " texels";
  }

  /// The blend of a texel in double; none where rounding may decide.
  struct Expected {
    dvec4 color = dvec4(0.0);
    double distance_m = 0.0;
    double slack_m = 0.0;  ///< error of the distance that rounding may cause
  };
  struct Layer {
    double distance_m;
    double slack_m;
    dvec4 light;
  };
  /// Whether rounding cannot change the order of two layers.
  static bool apart(const Layer& near, const Layer& far) {
    return far.distance_m - near.distance_m >= 1e-3 + far.slack_m + near.slack_m;
  }
  static std::optional<Expected> expected(const SyntheticView& seen, const ProxyScene& scene,
                                          const std::vector<vec4>& colors, uvec2 pixel, std::uint32_t layers) {
    const dvec3 at = seen.position(pixel.x, pixel.y) + seen.view.position, direction = seen.mirrored(pixel.x, pixel.y);
    std::vector<Layer> met;
    if (direction.y < kRayError) return std::nullopt;
    for (std::size_t i = 0; i < scene.proxies.size(); ++i) {
      const RayMeeting meeting = meet_in_double(scene.proxies[i], at, direction, kRayError);
      const auto shows = may_show(scene, i, seen.view.position, at.y);
      if (!shows && meeting.met) return std::nullopt;
      if (!shows.value_or(false)) continue;
      if (!meeting.decided) return std::nullopt;
      if (meeting.met) met.push_back({meeting.distance_m, meeting.slack_m, dvec4(colors[i])});
    }
    std::ranges::sort(met, {}, &Layer::distance_m);
    Expected result;
    for (std::size_t i = 0; i < std::min<std::size_t>(met.size(), layers); ++i) {
      if (i > 0 && !apart(met[i - 1], met[i])) return std::nullopt;
      const double part = 1.0 - result.color.w;
      result.slack_m += part * met[i].light.w * met[i].slack_m;
      result.distance_m += part * met[i].light.w * met[i].distance_m;
      result.color += part * met[i].light;
    }
    if (met.size() > layers && !apart(met[layers - 1], met[layers])) return std::nullopt;
    if (result.color.w > 0.0) result.distance_m /= result.color.w, result.slack_m /= result.color.w;
    return result;
  }
  /// The rule of rooms, with the slack of receivers.
  static std::optional<bool> may_show(const ProxyScene& scene, std::size_t i, const dvec3& camera, double height) {
    const dvec3 center(scene.proxies[i].world_from_node[3]);
    bool in_room = false, shared = false, others = false;
    std::vector<double> heights;
    for (const SceneRoom& room : scene.rooms) {
      const bool camera_inside = room.contains(camera), proxy_inside = room.contains(center);
      in_room |= camera_inside;
      others |= proxy_inside;
      if (!camera_inside || !proxy_inside) continue;
      if (!room.heights) shared |= height > room.floor() - 0.005;
      for (std::uint32_t h = 0; room.heights && h < room.heights->count; ++h)
        heights.push_back(static_cast<double>(room.heights->heights_m[h]));
    }
    for (const double stated : heights) shared |= std::abs(height - stated) < 0.005;
    // More than four heights may count as ranges.
    if (!shared && heights.size() > 4 && height > std::ranges::min(heights) && height < std::ranges::max(heights))
      return std::nullopt;
    return in_room ? shared : !others;
  }
};

// Hard case: selftest.proxy_tiles, selftest.tiles_naive
TEST_F(ProxyBlend, tiles_give_the_picture_of_the_naive_loop) {
  for (const ProxyCase& c : hard_cases()) {
    const ProxyWorld world(c.proxies);
    const FlatLayers images(device(), 4, 1, colors_of(world.set.proxies.size()));
    const SyntheticView seen = look(c.surfaces, c.camera);
    for (const auto& [scale, tiles] : {std::pair{1u, 16u}, {2u, 5u}}) {
      BlendInput in = blend_input(seen, scale);
      in.naive = true;
      in.sphere_test = false;
      const Blended naive = blend(device(), in, world, images);
      in.naive = false;
      in.sphere_test = true;
      expect_same(blend(device(), in, world, images, {.tiles = tiles}), naive,
                  c.name + ", " + std::to_string(tiles) + " tiles, scale " + std::to_string(scale));
    }
  }
}

// Hard case: reflections.camera_on_plane, reflections.straight_down, reflections.straight_up, reflections.edge_on
// Hard case: reflections.near_plane, reflections.behind_camera, reflections.larger_than_screen
// Hard case: reflections.horizontal, reflections.rooms_overlap, reflections.rooms_nested, reflections.two_floors
TEST_F(ProxyBlend, pictures_are_those_of_rays_in_double) {
  std::size_t compared = 0, shown = 0;
  std::uint32_t cases = 0;
  for (const ProxyCase& c : hard_cases()) {
    const ProxyWorld world(c.proxies);
    const std::vector<vec4> colors = colors_of(world.set.proxies.size());
    const FlatLayers images(device(), 4, 1, colors);
    const SyntheticView seen = look(c.surfaces, c.camera);
    for (const std::uint32_t layers : {1u + cases++ % 3u, 4u}) {
      BlendInput in = blend_input(seen, 1 + layers % 2);
      in.layers = layers;
      const Blended picture = blend(device(), in, world, images);
      std::size_t wrong = 0;
      for (std::uint32_t y = 0; y < in.constants.size.y; ++y)
        for (std::uint32_t x = 0; x < in.constants.size.x; ++x) {
          const std::size_t texel = std::size_t{y} * in.constants.size.x + x;
          const uvec2 pixel = surface_pixel(seen, in.constants.scale, {x, y});
          const std::size_t at = seen.at(pixel.x, pixel.y);
          const vec4 got = picture.color[texel];
          const bool reflects = seen.material[at] >> 24 != 0 && seen.object[at] >= 0 &&
                                unpack_normal_snorm16(seen.normals[at].y).y > 0.99f;
          if (!reflects) {
            EXPECT_EQ(got, vec4(0.0f));
            EXPECT_EQ(picture.surface[texel][1], 0);
            continue;
          }
          const auto want = expected(seen, c.proxies, colors, pixel, layers);
          if (!want) continue;
          ++compared;
          shown += want->color.w > 0.0 ? 1 : 0;
          bool same = glm::length(dvec4(got) - want->color) < 4e-3;
          if (want->color.w > 0.01)
            same &= std::abs(picture.distance_m(texel) - std::min(want->distance_m, 655.35)) <
                    0.006 + 2e-3 * want->distance_m + want->slack_m;
          if (!same && ++wrong < 3)
            ADD_FAILURE() << c.name << ", " << layers << " layers, texel " << x << ", " << y << ": " << got.r << " "
                          << got.g << " " << got.b << " " << got.a << " after " << picture.distance_m(texel)
                          << " m instead of " << want->color.r << " " << want->color.g << " " << want->color.b << " "
                          << want->color.a << " after " << want->distance_m;
        }
      EXPECT_EQ(wrong, 0u) << c.name << ", " << layers << " layers";
    }
  }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(shown, 2500u);
}

// Hard case: reflections.proxies_0, reflections.proxies_1, reflections.proxies_50, reflections.proxies_51
// Hard case: reflections.proxies_500
TEST_F(ProxyBlend, any_number_of_proxies_is_blended) {
  ProxyRandom random(33);
  for (const int count : {0, 1, 31, 32, 33, 50, 51, 500}) {
    const ProxyScene scene = random_proxies(random, count);
    const ProxyWorld world(scene);
    const std::vector<vec4> colors = colors_of(world.set.proxies.size());
    const FlatLayers images(device(), 4, 1, colors);
    const SyntheticView seen = look({}, turned({0.0, 1.6, 6.0}, 0.0, -0.3, 33, 25));
    BlendInput in = blend_input(seen, 1);
    const Blended tiled = blend(device(), in, world, images);
    in.naive = true;
    expect_same(tiled, blend(device(), in, world, images), std::to_string(count));
    std::size_t wrong = 0, compared = 0;
    for (std::uint32_t y = 0; y < 25; ++y)
      for (std::uint32_t x = 0; x < 33; ++x) {
        if (seen.object[seen.at(x, y)] != 0) continue;
        const auto want = expected(seen, scene, colors, {x, y}, 4);
        if (!want) continue;
        ++compared;
        wrong += glm::length(dvec4(tiled.color[seen.at(x, y)]) - want->color) < 4e-3 ? 0 : 1;
      }
    EXPECT_EQ(wrong, 0u) << count;
    EXPECT_GT(compared, 20u) << count;
  }
}

TEST_F(ProxyBlend, a_texel_stands_for_a_pixel_of_its_block_that_reflects) {
  ProxyScene scene;
  scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(400.0f));
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, colors_of(1));
  ProxyRandom random(36);
  for (std::uint32_t candidate = 0; candidate < 4; ++candidate) {
    // Odd sizes: blocks at the border have pixels outside the picture.
    SyntheticView seen = look({}, turned({0.3, 1.2, 3.0}, 0.1, -0.9, 37, 25));
    for (std::uint32_t& bytes : seen.material)
      if (random.one_in(2)) bytes = random.one_in(2) ? 0x00FF0000u : 0xFFFF00A0u;  // does not reflect, or rough
    BlendInput in = blend_input(seen, 2);
    in.constants.first_candidate = candidate;
    const Blended picture = blend(device(), in, world, images);
    std::size_t compared = 0;
    for (std::uint32_t y = 0; y < in.constants.size.y; ++y)
      for (std::uint32_t x = 0; x < in.constants.size.x; ++x) {
        const std::size_t texel = std::size_t{y} * in.constants.size.x + x;
        const uvec2 pixel = surface_pixel(seen, 2, {x, y}, candidate);
        const std::uint32_t bytes = seen.material[seen.at(pixel.x, pixel.y)];
        const bool reflects = bytes >> 24 != 0 && (bytes & 0xFFu) == 0;
        ASSERT_EQ(picture.surface[texel][1] > 0, reflects) << x << ", " << y << ", candidate " << candidate;
        const dvec3 from = seen.position(pixel.x, pixel.y) + seen.view.position;
        const double distance = (-4.0 - from.z) / seen.mirrored(pixel.x, pixel.y).z;
        if (!reflects || distance < 0.0 || distance > 100.0) continue;
        ASSERT_NEAR(picture.distance_m(texel), distance, 0.006 + 1e-4 * distance) << x << ", " << y;
        ++compared;
      }
    EXPECT_GT(compared, 100u);
  }
}

TEST_F(ProxyBlend, screen_space_is_a_layer_among_the_proxies) {
  // A transparent proxy 2 m away along z, an opaque one 6 m away, and a hit of screen space at several distances.
  ProxyScene scene;
  scene.add({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{{0.25f, 0.0f, 0.0f, 0.25f}, {0.0f, 1.0f, 0.0f, 1.0f}});
  const SyntheticView seen = look({}, turned({0.0, 1.0, 6.0}, 0.0, -0.3, 32, 24));
  for (const float share : {0.5f, 2.0f, 8.0f}) {
    int judged = 0;
    BlendInput in = blend_input(seen, 1);
    in.ssr_color.assign(32 * 24, vec4(0.0f, 0.0f, 3.0f, 0.5f));  // not premultiplied
    for (std::uint32_t texel = 0; texel < 32 * 24; ++texel) {
      const double first = (-seen.position(texel % 32, texel / 32).z - 6.0) / seen.mirrored(texel % 32, texel / 32).z;
      in.ssr_distance_m.push_back(std::max(share * static_cast<float>(first), 0.0f));
    }
    const Blended picture = blend(device(), in, world, images);
    for (std::uint32_t texel = 0; texel < 32 * 24; ++texel) {
      const uvec2 at(texel % 32, texel / 32);
      const dvec3 from = seen.position(at.x, at.y) + dvec3(0.0, 0.0, 6.0), direction = seen.mirrored(at.x, at.y);
      if (seen.object[texel] != 0 || from.z < 1.0 || direction.y < 1e-3) continue;
      const double first = -from.z / direction.z, second = (-4.0 - from.z) / direction.z,
                   screen{in.ssr_distance_m[texel]};
      if (std::abs(screen - first) < 0.5 || std::abs(screen - second) < 0.5) continue;
      std::vector<std::pair<double, dvec4>> layers = {
          {first, {0.25, 0.0, 0.0, 0.25}}, {second, {0.0, 1.0, 0.0, 1.0}}, {screen, {0.0, 0.0, 1.5, 0.5}}};
      std::ranges::sort(layers, {}, &std::pair<double, dvec4>::first);
      dvec4 want(0.0);
      for (const auto& layer : layers) want += (1.0 - want.w) * layer.second;
      ++judged;
      ASSERT_LT(glm::length(dvec4(picture.color[texel]) - want), 4e-3) << share << ", texel " << at.x << ", " << at.y;
    }
    EXPECT_GT(judged, 50) << share;
  }
}

TEST_F(ProxyBlend, a_hit_of_screen_space_hides_the_proxy_of_the_same_surface) {
  ProxyScene scene;
  scene.add({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{{1.0f, 0.0f, 0.0f, 1.0f}});
  const SyntheticView seen = look({}, turned({0.0, 1.0, 6.0}, 0.0, -0.3, 32, 24));
  for (const float beyond : {-0.4f, 0.2f, 0.6f}) {
    BlendInput in = blend_input(seen, 1);
    in.ssr_color.assign(32 * 24, vec4(0.0f, 1.0f, 0.0f, 1.0f));
    for (std::uint32_t i = 0; i < 32 * 24; ++i) {
      const double proxy = (-seen.position(i % 32, i / 32).z - 6.0) / seen.mirrored(i % 32, i / 32).z;
      in.ssr_distance_m.push_back(std::clamp(static_cast<float>(proxy) + beyond, 0.0f, 600.0f));
    }
    const Blended picture = blend(device(), in, world, images);
    std::size_t compared = 0;
    for (std::uint32_t i = 0; i < 32 * 24; ++i) {
      if (seen.object[i] != 0 || in.ssr_distance_m[i] < 1.0f || seen.position(i % 32, i / 32).z + 6.0 < 1.0) continue;
      ASSERT_EQ(picture.color[i].g, beyond < 0.5f ? 1.0f : 0.0f) << beyond << ", " << i;
      ++compared;
    }
    EXPECT_GT(compared, 100u);
  }
}

TEST_F(ProxyBlend, a_proxy_without_light_takes_no_layer) {
  ProxyScene scene;
  scene.add({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{vec4(1.0f), {0.0f, 1.0f, 0.0f, 1.0f}});
  const SyntheticView seen = look({}, turned({0.0, 1.0, 6.0}, 0.0, -0.3, 32, 24));
  BlendInput in = blend_input(seen, 1);
  in.layers = 1;
  std::vector<shaders::ProxyRow> rows = world.rows(seen.view, false);
  ASSERT_EQ(rows.size(), 2u);
  rows[0].opacity = 0.0f;
  const Blended picture = blend(device(), in, rows, world.tiles(seen.view, {.columns = 32}), images);
  for (std::uint32_t i = 0; i < 32 * 24; ++i)
    if (seen.object[i] == 0 && seen.mirrored(i % 32, i / 32).y > 1e-3 && seen.position(i % 32, i / 32).z + 6.0 > 0.0) {
      ASSERT_EQ(picture.color[i], vec4(0.0f, 1.0f, 0.0f, 1.0f)) << i;
    }
}

TEST_F(ProxyBlend, a_white_surrounding_is_white_at_every_confidence) {
  // Radiance 1 everywhere: each premultiplied colour must equal its confidence, which is at most 1.
  ProxyRandom random(35);
  const ProxyScene scene = random_proxies(random, 60);
  const ProxyWorld world(scene);
  std::vector<vec4> colors;
  for (int i = 0; i < 60; ++i) colors.emplace_back(static_cast<float>(random.index(5)) / 4.0f);
  const FlatLayers images(device(), 4, 1, colors);
  const SyntheticView seen = look({}, turned({0.0, 1.6, 6.0}, 0.0, -0.3));
  for (const std::uint32_t layers : {1u, 2u, 3u, 4u}) {
    BlendInput in = blend_input(seen, 2);
    in.layers = layers;
    for (std::uint32_t i = 0; i < in.constants.size.x * in.constants.size.y; ++i) {
      in.ssr_color.emplace_back(1.0f, 1.0f, 1.0f, static_cast<float>(random.between(0.0, 1.0)));
      in.ssr_distance_m.push_back(static_cast<float>(random.between(0.0, 8.0)));
    }
    std::size_t covered = 0;
    for (const vec4& color : blend(device(), in, world, images).color) {
      for (int i = 0; i < 3; ++i) ASSERT_NEAR(color[i], color.a, 1e-3f);
      ASSERT_LE(color.a, 1.0005f);
      covered += color.a > 0.9f ? 1 : 0;
    }
    EXPECT_GT(covered, 50u);
  }
}

TEST_F(ProxyBlend, without_screen_space_and_proxies_nothing_is_reflected) {
  const ProxyWorld world(ProxyScene{});
  const FlatLayers images(device(), 4, 1, colors_of(1));
  const SyntheticView seen = look({}, turned({0.0, 1.6, 6.0}, 0.0, -0.3));
  BlendInput in = blend_input(seen, 2);
  in.proxies_on = false;
  for (const vec4& color : blend(device(), in, world, images).color) ASSERT_EQ(color, vec4(0.0f));
  in.ssr_color.assign(31 * 19, vec4(5.0f, 5.0f, 5.0f, 0.0f));  // no confidence
  for (const vec4& color : blend(device(), in, world, images).color) ASSERT_EQ(color, vec4(0.0f));
}

TEST_F(ProxyBlend, reflections_fade_with_tilt_and_roughness) {
  ProxyScene scene;
  scene.add({0.0, 0.0, -4.0}, {0.0, 0.0, 1.0}, vec2(200.0f));
  const ProxyWorld world(scene);
  const FlatLayers images(device(), 4, 1, std::vector<vec4>{vec4(1.0f)});
  const auto share = [&](double tilt_degrees, std::uint32_t roughness) {
    SyntheticView seen = look({.floor_material = 0xFFFF0000u | roughness}, turned({0.0, 1.0, 6.0}, 0.0, -0.3, 9, 9));
    const double tilt = tilt_degrees * 0.017453292519943295;
    for (uvec2& normals : seen.normals) normals.y = pack_normal_snorm16(vec3(std::sin(tilt), std::cos(tilt), 0.0));
    const vec4 color = blend(device(), blend_input(seen, 1), world, images).color[seen.at(4, 6)];
    EXPECT_NEAR(color.r, color.a, 1e-3f);
    return color.a;
  };
  EXPECT_EQ(share(14.0, 0), 1.0f);
  EXPECT_GT(share(18.0, 0), share(22.0, 0));
  EXPECT_GT(share(22.0, 0), share(27.0, 0));
  EXPECT_GT(share(27.0, 0), 0.0f);
  EXPECT_EQ(share(31.0, 0), 0.0f);
  EXPECT_EQ(share(0.0, 96), 1.0f);
  EXPECT_GT(share(0.0, 104), share(0.0, 116));
  EXPECT_GT(share(0.0, 116), 0.0f);
  EXPECT_EQ(share(0.0, 126), 0.0f);
}

TEST_F(ProxyBlend, distances_are_those_of_the_format_and_spreads_grow_with_them) {
  const ProxyWorld world(ProxyScene{});
  const FlatLayers images(device(), 4, 1, colors_of(1));
  // The second camera looks down so steeply that mirrored rays pass beside it and end behind it.
  for (const auto& [by_roughness, pitch] : {std::pair{true, -0.4}, {false, -0.4}, {false, -1.2}}) {
    const SyntheticView seen = look({}, turned({0.0, 1.6, 6.0}, 0.0, pitch, 16, 16));
    std::vector<std::uint8_t> last(16 * 16, 0);
    for (const float metres : {0.0f, 0.4f, 2.55f, 2.56f, 20.0f, 655.35f}) {
      BlendInput in = blend_input(seen, 1);
      in.constants.pixel_roughness = by_roughness ? 1 : 0;
      in.ssr_color.assign(256, vec4(1.0f));
      in.ssr_distance_m.assign(256, metres);
      const Blended picture = blend(device(), in, world, images);
      for (std::uint32_t i = 0; i < 256; ++i) {
        if (seen.object[i] != 0) continue;
        ASSERT_NEAR(picture.distance_m(i), metres, 0.0051);
        const dvec3 at = seen.position(i % 16, i / 16), hit = at + seen.mirrored(i % 16, i / 16) * double{metres};
        double spread = double{metres} / (double{metres} + glm::length(at));
        if (!by_roughness) {
          const double depth = -(dmat4(seen.view.view_from_relative) * dvec4(hit, 1.0)).z;
          spread = depth <= double{seen.view.near_m}
                       ? 1.0
                       : std::min(glm::length(ndc_of(seen.view, hit) - ndc_of(seen.view, at)), 1.0);
        }
        ASSERT_NEAR(picture.surface[i][0], 255.0 * spread, 0.6) << metres << ", " << by_roughness;
        if (by_roughness) {
          ASSERT_GE(picture.surface[i][0], last[i]);
        }
        last[i] = picture.surface[i][0];
        ASSERT_EQ(picture.surface[i][1], 1) << "roughness 0 is a mirror, not a missing surface";
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test
