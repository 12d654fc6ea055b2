// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Selection and ranking of lights against a simple version in double precision, and bit-identical results from every
// executor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/render/view.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {
namespace {

constexpr double kHalfPi = 1.5707963267948966;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct CrowdedScene {
  RenderView view;
  std::vector<PlacedLight> lights;

  CrowdedScene(std::uint32_t seed, std::uint32_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto direction = [&] { return glm::normalize(dvec3(unit(random), unit(random), unit(random) + 1e-3)); };
    ViewSettings settings;
    settings.width = 200 + 100 * (seed % 4);
    settings.height = 150 + 70 * (seed % 3);
    settings.camera.orthographic = seed % 5 == 4;
    settings.camera.half_height_m = 15.0f;
    settings.camera.fov_y = static_cast<float>(0.9 + 0.5 * unit(random));
    const dmat4 camera = glm::translate(dmat4(1.0), 3000.0 * dvec3(unit(random), 0.01 * unit(random), unit(random))) *
                         glm::rotate(dmat4(1.0), 3.0 * unit(random), direction());
    settings.world_from_camera = camera;
    view = make_view(settings, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      PlacedLight placed;
      placed.entity = {i, 1};
      placed.light.kind = i % 3 == 0 ? LightKind::spot : LightKind::point;
      placed.light.range_m = static_cast<float>(std::exp2(1.0 + 2.0 * unit(random)));
      placed.light.intensity = static_cast<float>(std::exp2(5.0 * unit(random)));
      placed.light.color = vec3(dvec3(1.0 + unit(random), 1.0 + unit(random), 1.0 + unit(random)) * 0.5 + 0.01);
      placed.light.outer_angle = static_cast<float>(0.8 + 0.7 * unit(random));
      // Mostly in front of the camera, some behind or beside it.
      const dvec3 seen(25.0 * unit(random), 18.0 * unit(random), -30.0 + 40.0 * unit(random));
      placed.position = dvec3(camera * dvec4(seen, 1.0));
      placed.direction = vec3(direction());
      // Some have the same position and intensity.
      if (i % 7 == 6) {
        const Entity entity = placed.entity;
        placed = lights.back();
        placed.entity = entity;
      }
      lights.push_back(placed);
    }
  }
};

/// The values that decide about a light, in double precision.
struct Facts {
  double inside = kInfinity;  ///< metres by which its bound reaches inside the frustum's worst plane
  double importance = 0.0;
  double nearest = 0.0;
};

Facts facts_of(const PlacedLight& placed, const RenderView& view) {
  const Light& light = placed.light;
  const double range = effective_range(light);
  double along = 0.0;
  double radius = range;
  if (light.kind == LightKind::spot) {
    const double angle = light.outer_angle;
    const bool wide = angle > 0.7853981633974483;
    along = range * (wide ? std::cos(angle) : 0.5 / std::cos(angle));
    radius = range * (wide ? std::sin(angle) : 0.5 / std::cos(angle));
  }
  const dvec3 center = placed.position - view.position + along * dvec3(placed.direction);
  const dmat4 rows = glm::transpose(dmat4(view.clip_from_relative));
  Facts facts;
  for (const dvec4& plane :
       {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] - rows[2], rows[2]}) {
    const double length = glm::length(dvec3(plane));
    if (length < 1e-9) continue;  // an infinitely far plane
    facts.inside = std::min(facts.inside, (glm::dot(dvec3(plane), center) + plane.w) / length + radius);
  }
  const double distance = std::max(glm::length(center), radius);
  const double brightest = std::max({light.color.r, light.color.g, light.color.b});
  facts.importance = radius * radius / (distance * distance) * brightest * static_cast<double>(light.intensity);
  const dvec3 forward = -dvec3(glm::transpose(view.view_from_relative)[2]);
  facts.nearest = std::max<double>(view.near_m, glm::dot(forward, center) - radius);
  if (light.kind != LightKind::spot) return facts;
  // The nearest point of a cone is its apex or the point of its cap whose direction is nearest to the camera's back.
  const double from_back =
      std::acos(std::clamp(glm::dot(glm::normalize(dvec3(placed.direction)), -forward), -1.0, 1.0));
  const double behind = std::cos(std::clamp<double>(from_back - light.outer_angle, 0.0, kHalfPi));
  facts.nearest = std::max(facts.nearest, glm::dot(forward, placed.position - view.position) - range * behind);
  return facts;
}

struct Selected {
  LightTable table;
  VisibleLights visible;
};

std::unique_ptr<Selected> select(const CrowdedScene& scene, JobExecutor& executor) {
  auto selected = std::make_unique<Selected>();
  selected->table.resize(scene.lights.size());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    selected->table.set_light(i, scene.lights[i]);
    selected->table.set_place(i, scene.lights[i]);
  }
  select_lights(scene.lights, selected->table, scene.view, executor, selected->visible);
  return selected;
}

void expect_best_lights(const CrowdedScene& scene, const VisibleLights& visible) {
  constexpr double kUnsure = 1e-3;  // metres: within this, rounding may decide either way
  std::map<std::uint32_t, Facts> chosen;
  double least_kept = kInfinity;
  for (const Entity entity : visible.local_entities) {
    const Facts facts = facts_of(scene.lights[entity.index], scene.view);
    EXPECT_GT(facts.inside, -kUnsure) << "light " << entity.index << " is outside";
    EXPECT_TRUE(chosen.emplace(entity.index, facts).second) << "light " << entity.index << " came twice";
    least_kept = std::min(least_kept, facts.importance);
  }
  std::size_t surely = 0;
  std::size_t perhaps = 0;
  for (const PlacedLight& light : scene.lights) {
    const Facts facts = facts_of(light, scene.view);
    surely += facts.inside > kUnsure ? 1 : 0;
    perhaps += facts.inside > -kUnsure ? 1 : 0;
    if (facts.inside < kUnsure || chosen.contains(light.entity.index)) continue;
    EXPECT_EQ(chosen.size(), std::size_t{GLOAM_MAX_LOCAL_LIGHTS}) << "light " << light.entity.index << " is missing";
    EXPECT_LE(facts.importance, least_kept * (1.0 + 1e-5)) << "light " << light.entity.index << " was dropped";
  }
  EXPECT_GE(chosen.size() + visible.dropped, surely);
  EXPECT_LE(chosen.size() + visible.dropped, perhaps);
  EXPECT_EQ(visible.dropped > 0, chosen.size() + visible.dropped > GLOAM_MAX_LOCAL_LIGHTS);
}

void expect_order(const CrowdedScene& scene, const VisibleLights& visible) {
  for (std::size_t i = 0; i < visible.local_entities.size(); ++i) {
    const Facts facts = facts_of(scene.lights[visible.local_entities[i].index], scene.view);
    EXPECT_NEAR(static_cast<double>(visible.depths[i].nearest), facts.nearest, 1e-3);
    EXPECT_EQ(visible.block.local[i].position,
              scene.view.relative(scene.lights[visible.local_entities[i].index].position));
    if (i == 0) continue;
    EXPECT_LE(visible.depths[i - 1].nearest, visible.depths[i].nearest);
    if (visible.depths[i - 1].nearest == visible.depths[i].nearest) {
      EXPECT_LT(visible.local_entities[i - 1].index, visible.local_entities[i].index);
    }
  }
}

template <class T>
bool same_bytes(const T* a, const T* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}

void expect_same(const VisibleLights& a, const VisibleLights& b) {
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_EQ(a.total, b.total);
  ASSERT_EQ(a.local_entities, b.local_entities);
  const std::size_t count = a.local_entities.size();
  EXPECT_TRUE(same_bytes(a.block.local, b.block.local, count));
  EXPECT_TRUE(same_bytes(a.depths.data(), b.depths.data(), count));
  EXPECT_TRUE(same_bytes(a.mask_lights.data(), b.mask_lights.data(), count));
}

constexpr std::uint32_t kCounts[] = {1, 63, 64, 255, 256, 257, 1000, 1023, 1024, 1025, 1500, 4001};

TEST(SelectLightsHard, keeps_the_lights_that_a_plain_version_in_double_ranks_first) {
  const auto executor = make_serial_executor();
  bool dropped = false;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    for (const std::uint32_t count : kCounts) {
      const CrowdedScene scene(seed, count);
      const auto selected = select(scene, *executor);
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << count << " lights");
      expect_best_lights(scene, selected->visible);
      expect_order(scene, selected->visible);
      dropped = dropped || selected->visible.dropped > 0;
    }
  }
  EXPECT_TRUE(dropped) << "no scene had too many lights";
}

TEST(SelectLightsHard, chooses_the_same_bits_with_every_executor) {
  std::vector<std::unique_ptr<JobExecutor>> executors;
  for (const std::uint32_t threads : {1u, 2u, 3u, 8u}) executors.push_back(make_pool_executor(threads));
  for (const std::uint64_t seed : {1u, 2u}) executors.push_back(make_shuffled_executor(seed));
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    for (const std::uint32_t count : kCounts) {
      const CrowdedScene scene(seed, count);
      const auto expected = select(scene, *make_serial_executor());
      for (std::size_t e = 0; e < executors.size(); ++e) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << count << " lights, executor " << e);
        expect_same(select(scene, *executors[e])->visible, expected->visible);
      }
    }
  }
}

TEST(SelectLightsHard, finds_the_same_after_any_other_count_of_lights) {
  const auto executor = make_pool_executor(2);
  Selected reused;
  for (const std::uint32_t count : {1024u, 4001u, 3u, 1025u, 300u, 0u, 1024u}) {
    const CrowdedScene scene(count, count);
    const auto expected = select(scene, *make_serial_executor());
    select_lights(scene.lights, expected->table, scene.view, *executor, reused.visible);
    expect_same(reused.visible, expected->visible);
  }
}

}  // namespace
}  // namespace gloam
