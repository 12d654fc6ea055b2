// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>
#include <set>

#include "modules/lights/selection/light_list.h"

#include "engine/render/view.h"

namespace gloam {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

RenderView looking_along_minus_z(dvec3 position = dvec3(0.0)) {
  ViewSettings settings;
  settings.width = 320;
  settings.height = 180;
  settings.world_from_camera = glm::translate(dmat4(1.0), position);
  return make_view(settings, 0);
}

PlacedLight point_at(std::uint32_t entity, dvec3 position, float range = 5.0f, float intensity = 10.0f) {
  PlacedLight placed;
  placed.entity = {entity, 1};
  placed.light.range_m = range;
  placed.light.intensity = intensity;
  placed.position = position;
  return placed;
}

std::unique_ptr<VisibleLights> select(const std::vector<PlacedLight>& lights, const RenderView& view) {
  auto visible = std::make_unique<VisibleLights>();
  select_lights(lights, view, *visible);
  EXPECT_EQ(visible->local_entities.size(), visible->block.local_count);
  EXPECT_EQ(visible->directional_entities.size(), visible->block.directional_count);
  EXPECT_EQ(visible->total, lights.size());
  return visible;
}

/// Random lights of all kinds around a random camera.
struct RandomScene {
  RenderView view;
  std::vector<PlacedLight> lights;
  std::mt19937 random;

  explicit RandomScene(std::uint32_t seed) : random(seed) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    ViewSettings settings;
    settings.width = 321 + seed % 5;
    settings.height = 100 + 40 * (seed % 7);
    settings.camera.orthographic = seed % 4 == 3;
    settings.camera.half_height_m = 12.0f;
    settings.camera.fov_y = static_cast<float>(0.9 + 0.6 * unit(random));
    const dvec3 eye(1000.0 * unit(random), 10.0 * unit(random), 1000.0 * unit(random));
    settings.world_from_camera = glm::translate(dmat4(1.0), eye) *
                                 glm::rotate(dmat4(1.0), 3.0 * unit(random),
                                             glm::normalize(dvec3(unit(random), unit(random), unit(random) + 1.5)));
    view = make_view(settings, 0);
    for (std::uint32_t i = 0; i < 400; ++i) {
      PlacedLight placed = point_at(i, eye + 40.0 * dvec3(unit(random), unit(random), unit(random)));
      placed.light.range_m = static_cast<float>(6.0 + 5.9 * unit(random));
      placed.light.intensity = static_cast<float>(50.0 + 49.0 * unit(random));
      placed.direction = glm::normalize(vec3(dvec3(unit(random), unit(random), unit(random) + 1e-3)));
      if (i % 2 == 0) {
        placed.light.kind = LightKind::spot;
        placed.light.outer_angle = static_cast<float>(0.8 + 0.77 * unit(random));
      }
      lights.push_back(placed);
    }
  }
};

bool lights_point(const PlacedLight& placed, const dvec3& world) {
  const dvec3 offset = world - placed.position;
  const double distance = glm::length(offset);
  if (distance > static_cast<double>(effective_range(placed.light))) return false;
  if (placed.light.kind == LightKind::point) return true;
  return glm::dot(offset, dvec3(placed.direction)) >=
         distance * std::cos(static_cast<double>(placed.light.outer_angle));
}

bool in_clip(const RenderView& view, const dvec3& relative) {
  const dvec4 p = dmat4(view.clip_from_relative) * dvec4(relative, 1.0);
  return p.w > 0.0 && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0.0 && p.z <= p.w;
}

TEST(SelectLights, misses_no_light_that_lights_a_point_of_the_frustum) {
  std::size_t lit = 0;
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    RandomScene scene(seed);
    const auto visible = select(scene.lights, scene.view);
    std::set<std::uint32_t> chosen;
    for (const Entity e : visible->local_entities) chosen.insert(e.index);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 3000; ++i) {
      const dvec3 relative = 45.0 * dvec3(unit(scene.random), unit(scene.random), unit(scene.random));
      if (!in_clip(scene.view, relative)) continue;
      for (const PlacedLight& light : scene.lights) {
        if (lights_point(light, scene.view.position + relative)) {
          ++lit;
          ASSERT_TRUE(chosen.contains(light.entity.index)) << "seed " << seed << ", light " << light.entity.index;
        }
      }
    }
    EXPECT_LT(chosen.size(), scene.lights.size()) << "everything was chosen";
  }
  EXPECT_GT(lit, 1000u);
}

TEST(SelectLights, agrees_with_the_planes_in_double_precision) {
  for (std::uint32_t seed = 0; seed < 24; ++seed) {
    const RandomScene scene(seed);
    const auto visible = select(scene.lights, scene.view);
    std::set<std::uint32_t> chosen;
    for (const Entity e : visible->local_entities) chosen.insert(e.index);
    const dmat4 rows = glm::transpose(dmat4(scene.view.clip_from_relative));
    const dvec4 planes[] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                            rows[3] - rows[1], rows[3] - rows[2], rows[2]};
    for (const PlacedLight& light : scene.lights) {
      const Sphere bounds = light_bounds(light, scene.view.position);
      double least = std::numeric_limits<double>::infinity();  // least reach of the bounds inside the worst plane
      for (const dvec4& plane : planes) {
        const double length = glm::length(dvec3(plane));
        if (length < 1e-9) continue;  // an infinitely far plane
        least = std::min(least, (glm::dot(dvec3(plane), dvec3(bounds.center)) + plane.w) / length +
                                    static_cast<double>(bounds.radius));
      }
      if (least > 1e-3) {
        EXPECT_TRUE(chosen.contains(light.entity.index)) << "seed " << seed;
      }
      if (least < -1e-3) {
        EXPECT_FALSE(chosen.contains(light.entity.index)) << "seed " << seed;
      }
    }
  }
}

TEST(SelectLights, orders_by_nearest_view_depth_then_by_entity) {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const RandomScene scene(seed);
    const auto visible = select(scene.lights, scene.view);
    ASSERT_GT(visible->block.local_count, 3u);
    const dvec3 forward = -dvec3(glm::transpose(scene.view.view_from_relative)[2]);
    double last = -1.0;
    std::uint32_t last_entity = 0;
    for (std::uint32_t i = 0; i < visible->block.local_count; ++i) {
      const PlacedLight& light = scene.lights[visible->local_entities[i].index];
      const Sphere bounds = light_bounds(light, scene.view.position);
      const double sphere =
          std::max<double>(scene.view.near_m, glm::dot(forward, dvec3(bounds.center)) - bounds.radius);
      const double depth = visible->depths[i].nearest;
      ASSERT_GE(depth, sphere - 1e-4) << "seed " << seed;
      if (light.light.kind != LightKind::spot) {
        ASSERT_NEAR(depth, sphere, 1e-4) << "seed " << seed;
      }
      ASSERT_GE(depth, last) << "seed " << seed;
      if (depth == static_cast<double>(scene.view.near_m) && last == depth) {
        ASSERT_GT(light.entity.index, last_entity);
      }
      last = depth;
      last_entity = light.entity.index;
      EXPECT_EQ(visible->block.local[i].position, scene.view.relative(light.position));
    }
  }
}

TEST(SelectLights, packs_what_shading_reads) {
  PlacedLight spot = point_at(4, dvec3(0.0, 1.0, -6.0), 8.0f, 20.0f);
  spot.light.kind = LightKind::spot;
  spot.light.color = vec3(1.0f, 0.5f, 0.25f);
  spot.direction = vec3(0.0f, -1.0f, 0.0f);
  PlacedLight sun = point_at(5, dvec3(0.0), 0.0f, 3.0f);
  sun.light.kind = LightKind::directional;
  sun.light.apparent_angle = 0.01f;
  sun.direction = vec3(1.0f, 0.0f, 0.0f);
  const auto visible = select({spot, sun}, looking_along_minus_z());
  ASSERT_EQ(visible->block.local_count, 1u);
  ASSERT_EQ(visible->block.directional_count, 1u);
  const shaders::LocalLight& local = visible->block.local[0];
  EXPECT_EQ(local.position, vec3(0.0f, 1.0f, -6.0f));
  EXPECT_EQ(local.color, vec3(20.0f, 10.0f, 5.0f));
  EXPECT_FLOAT_EQ(local.inverse_range_squared, 1.0f / 64.0f);
  EXPECT_EQ(local.direction, spot.direction);
  EXPECT_EQ(vec2(local.spot_scale, local.spot_offset), spot_ramp(spot.light));
  EXPECT_EQ(visible->block.directional[0].color, vec3(3.0f));
  EXPECT_EQ(visible->block.directional[0].direction, sun.direction);
  EXPECT_EQ(visible->block.directional[0].apparent_angle, 0.01f);
  EXPECT_EQ(visible->directional_entities[0].index, 5u);
}

TEST(SelectLights, takes_any_count_up_to_the_capacity) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u}) {
    std::vector<PlacedLight> lights;
    for (std::uint32_t i = 0; i < count; ++i) lights.push_back(point_at(i, dvec3(0.0, 0.0, -10.0)));
    const auto visible = select(lights, looking_along_minus_z());
    EXPECT_EQ(visible->block.local_count, count);
    EXPECT_EQ(visible->dropped, 0u);
  }
}

TEST(SelectLights, forgets_the_lights_of_the_frame_before) {
  VisibleLights visible;
  std::vector<PlacedLight> lights = {point_at(0, dvec3(0.0, 0.0, -10.0)), point_at(1, dvec3(0.0, 0.0, -10.0))};
  select_lights(lights, looking_along_minus_z(), visible);
  EXPECT_EQ(visible.local_entities.size(), 2u);
  lights.pop_back();
  select_lights(lights, looking_along_minus_z(), visible);
  EXPECT_EQ(visible.local_entities.size(), 1u);
  EXPECT_EQ(visible.block.local_count, 1u);
  EXPECT_EQ(visible.total, 1u);
}

TEST(SelectLights, of_equal_lights_beyond_the_capacity_keeps_the_first_entities) {
  for (const std::uint32_t count : {1025u, 5000u}) {
    std::vector<PlacedLight> lights;
    for (std::uint32_t i = 0; i < count; ++i) lights.push_back(point_at(i, dvec3(0.0, 0.0, -10.0)));
    const auto visible = select(lights, looking_along_minus_z());
    ASSERT_EQ(visible->block.local_count, 1024u);
    EXPECT_EQ(visible->dropped, count - 1024u);
    for (std::uint32_t i = 0; i < 1024; ++i) ASSERT_EQ(visible->local_entities[i].index, i);
  }
}

TEST(SelectLights, beyond_the_capacity_keeps_the_largest_coverage_times_intensity) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<PlacedLight> lights;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    lights.push_back(point_at(i, dvec3(0.0, 0.0, -5.0 - 90.0 * unit(random)),
                              static_cast<float>(0.5 + 4.0 * unit(random)),
                              static_cast<float>(1.0 + 100.0 * unit(random))));
  }
  const auto visible = select(lights, looking_along_minus_z());
  ASSERT_EQ(visible->block.local_count, 1024u);
  EXPECT_EQ(visible->dropped, 3000u - 1024u);
  std::set<std::uint32_t> kept;
  for (const Entity e : visible->local_entities) kept.insert(e.index);
  const auto importance = [](const PlacedLight& light) {
    const double radius = static_cast<double>(light.light.range_m);
    const double distance = std::max(glm::length(light.position), radius);
    return radius * radius / (distance * distance) * static_cast<double>(light.light.intensity);
  };
  double least_kept = std::numeric_limits<double>::infinity();
  double most_dropped = 0.0;
  for (const PlacedLight& light : lights) {
    if (kept.contains(light.entity.index))
      least_kept = std::min(least_kept, importance(light));
    else
      most_dropped = std::max(most_dropped, importance(light));
  }
  EXPECT_GE(least_kept, most_dropped * (1.0 - 1e-5));
}

TEST(SelectLights, keeps_the_sixteen_brightest_directional_lights_in_entity_order) {
  std::vector<PlacedLight> lights;
  for (std::uint32_t i = 0; i < 20; ++i) {
    lights.push_back(point_at(i, dvec3(0.0), 0.0f, i < 4 ? 1.0f : 10.0f));
    lights.back().light.kind = LightKind::directional;
  }
  const auto visible = select(lights, looking_along_minus_z());
  ASSERT_EQ(visible->block.directional_count, 16u);
  EXPECT_EQ(visible->dropped, 4u);
  for (std::uint32_t i = 0; i < 16; ++i) EXPECT_EQ(visible->directional_entities[i].index, i + 4);
}

TEST(SelectLights, leaves_out_lights_that_give_nothing) {
  std::vector<PlacedLight> lights;
  for (const float intensity : {0.0f, -0.0f, -10.0f}) {
    for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
      lights.push_back(point_at(static_cast<std::uint32_t>(lights.size()), dvec3(0.0, 0.0, -4.0), 5.0f, intensity));
      lights.back().light.kind = kind;
    }
  }
  lights.push_back(point_at(99, dvec3(0.0, 0.0, -4.0)));
  lights.back().light.color = vec3(0.0f);
  const auto visible = select(lights, looking_along_minus_z());
  EXPECT_EQ(visible->block.local_count + visible->block.directional_count, 0u);
  EXPECT_EQ(visible->dropped, 0u);
}

/// Checks every number that reaches the GPU.
void expect_finite(const VisibleLights& visible) {
  const auto check = [](const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  for (std::uint32_t i = 0; i < visible.block.local_count; ++i) {
    const shaders::LocalLight& l = visible.block.local[i];
    ASSERT_TRUE(check(l.position) && check(l.color) && check(l.direction)) << i;
    ASSERT_TRUE(std::isfinite(l.inverse_range_squared) && std::isfinite(l.spot_scale) && std::isfinite(l.spot_offset))
        << i;
  }
  for (std::uint32_t i = 0; i < visible.block.directional_count; ++i) {
    const shaders::DirectionalLight& d = visible.block.directional[i];
    ASSERT_TRUE(check(d.color) && check(d.direction) && std::isfinite(d.apparent_angle)) << i;
  }
}

// Hard case: shadows.position_not_finite, shadows.intensity_not_finite, shadows.range_not_finite
TEST(SelectLights, lets_no_nan_and_no_infinity_reach_the_gpu) {
  std::vector<PlacedLight> lights;
  const auto add = [&](const PlacedLight& light) {
    for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
      lights.push_back(light);
      lights.back().entity.index = static_cast<std::uint32_t>(lights.size()) - 1;
      lights.back().light.kind = kind;
    }
  };
  for (const float bad : {kNan, kInfinity, -kInfinity, 1e38f}) {
    const PlacedLight good = point_at(0, dvec3(0.0, 0.0, -10.0));
    PlacedLight l = good;
    l.light.intensity = bad;
    add(l);
    l = good;
    l.light.range_m = bad;
    add(l);
    for (int channel = 0; channel < 3; ++channel) {
      l = good;
      l.light.color[channel] = bad;
      add(l);
      l = good;
      l.position[channel] = static_cast<double>(bad);
      add(l);
      l.position[channel] = static_cast<double>(bad) * 1e60;
      add(l);
      l = good;
      l.direction[channel] = bad;
      if (bad != 1e38f) add(l);
    }
    l = good;
    l.light.inner_angle = bad;
    add(l);
    l = good;
    l.light.outer_angle = bad;
    add(l);
    l = good;
    l.light.apparent_angle = bad;
    add(l);
  }
  add(point_at(0, dvec3(0.0, 0.0, -10.0)));
  const auto visible = select(lights, looking_along_minus_z());
  expect_finite(*visible);
  EXPECT_GE(visible->block.local_count, 2u) << "good lights stay";
  // Many of them: if NaN broke the comparison of a sort, it would now leave the bounds of the array.
  std::vector<PlacedLight> many;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    many.push_back(lights[i % lights.size()]);
    many.back().entity.index = i;
  }
  const auto crowd = select(many, looking_along_minus_z());
  expect_finite(*crowd);
}

TEST(SelectLights, clips_negative_channels_to_black) {
  PlacedLight light = point_at(0, dvec3(0.0, 0.0, -4.0), 5.0f, 2.0f);
  light.light.color = vec3(1.0f, -1.0f, 0.5f);
  const auto visible = select({light}, looking_along_minus_z());
  ASSERT_EQ(visible->block.local_count, 1u);
  EXPECT_EQ(visible->block.local[0].color, vec3(2.0f, 0.0f, 1.0f));
}

TEST(SelectLights, finds_lights_around_the_camera_behind_it_and_across_the_near_plane) {
  std::vector<PlacedLight> lights = {
      point_at(0, dvec3(0.0, 0.0, 0.0)),                 // around the camera
      point_at(1, dvec3(0.0, 0.0, 2.0)),                 // behind the camera, but reaching in front of it
      point_at(2, dvec3(0.0, 0.0, 6.0)),                 // behind the camera
      point_at(3, dvec3(0.0, 0.0, -0.1), 0.01f),         // straddles the near plane
      point_at(4, dvec3(0.0, 0.0, -5000.0), 1.0f, 1e3f)  // far
  };
  const auto visible = select(lights, looking_along_minus_z());
  std::set<std::uint32_t> chosen;
  for (const Entity e : visible->local_entities) chosen.insert(e.index);
  EXPECT_EQ(chosen, (std::set<std::uint32_t>{0, 1, 3, 4}));
}

TEST(SelectLights, is_exact_far_from_the_worlds_origin) {
  const dvec3 far(1e5, 0.0, -1e5);
  const auto visible = select({point_at(0, far + dvec3(0.25, 0.5, -4.0))}, looking_along_minus_z(far));
  ASSERT_EQ(visible->block.local_count, 1u);
  EXPECT_EQ(visible->block.local[0].position, vec3(0.25f, 0.5f, -4.0f));
}

}  // namespace
}  // namespace gloam
