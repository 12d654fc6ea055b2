// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/schedule/schedule.h"
#include "modules/lights/light_set.h"
#include "modules/lights/module.h"
#include "modules/lights/selection/light_list.h"
#include "tests/modules/lights/masks/mask_oracle.h"

namespace gloam {
namespace {

using test::SceneRandom;

/// A world whose lights change in every possible way. The state that systems keep between frames must equal a fresh
/// rebuild.
struct ChangingWorld {
  World world;
  std::unique_ptr<Module> module = make_lights_module();
  Schedule schedule;
  KnobRegistry knobs;
  std::unique_ptr<JobExecutor> executor;
  std::vector<Entity> lights;
  std::vector<RenderView> views;
  SceneRandom random;

  ChangingWorld(std::uint32_t seed, std::unique_ptr<JobExecutor> with) : executor(std::move(with)), random(seed) {
    prepare_scene_world(world);
    module->register_components(world);
    module->add_systems(schedule);
    module->knobs(knobs);
    schedule.set_checked(true);
    for (std::uint32_t i = 0; i < 2; ++i) {
      views.emplace_back();
      move_camera(i);
    }
  }

  void move_camera(std::uint32_t i) {
    ViewSettings settings;
    settings.id = ViewId{i};
    settings.width = 100 + static_cast<std::uint32_t>(random.index(3)) * 33;
    settings.height = 80;
    settings.camera.orthographic = random.one_in(5);
    settings.camera.half_height_m = 10.0f;
    settings.world_from_camera = test::draw_pose(random, random.direction() * random.between(0.0, 8.0));
    views[i] = make_view(settings, 0);
  }

  Light some_light() {
    Light light;
    light.kind = random.one_in(12) ? LightKind::directional : random.one_in(2) ? LightKind::spot : LightKind::point;
    light.intensity = static_cast<float>(random.between(-0.5, 9.0));
    light.range_m = random.one_in(4) ? 0.0f : static_cast<float>(random.between(0.1, 9.0));
    light.outer_angle = static_cast<float>(random.between(0.0, 1.6));
    light.inner_angle = light.outer_angle * 0.5f;
    return light;
  }
  WorldTransform some_place() {
    return {test::draw_pose(random, random.direction() * random.between(0.0, 20.0)) *
            glm::scale(dmat4(1.0), dvec3(random.between(0.1, 3.0)))};
  }
  Entity some_entity() { return lights[static_cast<std::size_t>(random.index(static_cast<int>(lights.size())))]; }

  void create() {
    const Entity e = random.one_in(3) ? world.create(some_light(), some_place(), Parent{})
                                      : world.create(some_light(), some_place());
    lights.push_back(e);
  }

  void change() {
    if (lights.empty()) return create();
    const Entity e = some_entity();
    switch (random.index(9)) {
      case 0:
        return create();
      case 1:
        world.destroy(e);
        std::erase(lights, e);
        return;
      case 2:
        if (world.has<Light>(e)) {
          world.get<Light>(e) = some_light();
          world.mark_changed<Light>(e);
        } else {
          world.add(e, some_light());
        }
        return;
      case 3:
        if (world.has<WorldTransform>(e)) {
          world.get<WorldTransform>(e) = some_place();
          world.mark_changed<WorldTransform>(e);
        } else {
          world.add(e, some_place());
        }
        return;
      case 4:  // another archetype
        if (world.has<Parent>(e))
          world.remove<Parent>(e);
        else
          world.add(e, Parent{});
        return;
      case 5:
        world.remove<Light>(e);
        return;
      case 6:
        world.remove<WorldTransform>(e);
        return;
      case 7: {  // an equal light under another entity, in the same archetype
        if (!world.has<Light>(e) || !world.has<WorldTransform>(e)) return;
        const Light light = world.get<Light>(e);
        const WorldTransform place = world.get<WorldTransform>(e);
        world.destroy(e);
        std::erase(lights, e);
        lights.push_back(world.create(light, place));
        return;
      }
      default:
        return move_camera(static_cast<std::uint32_t>(random.index(2)));
    }
  }

  void run() {
    schedule.run(Stage::world, world, *executor);
    for (const RenderView& view : views) {
      world.set_view_resource(view.id, view);
      module->prepare_view(world, view.id, knobs);
      schedule.run_view(view.id, world, *executor);
    }
  }

  [[nodiscard]] std::vector<PlacedLight> placed_anew() const {
    std::vector<PlacedLight> placed;
    for (const Entity e : lights) {
      const Light* light = world.try_get<Light>(e);
      const WorldTransform* transform = world.try_get<WorldTransform>(e);
      if (light != nullptr && transform != nullptr) placed.push_back(place_light(e, *light, transform->matrix));
    }
    std::sort(placed.begin(), placed.end(),
              [](const PlacedLight& a, const PlacedLight& b) { return a.entity.index < b.entity.index; });
    return placed;
  }

  void expect_as_made_anew(int step) {
    const std::vector<PlacedLight> placed = placed_anew();
    const std::vector<PlacedLight>& kept = world.resource<LightSet>().lights;
    ASSERT_EQ(kept.size(), placed.size()) << "step " << step;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      ASSERT_EQ(kept[i].entity, placed[i].entity) << "step " << step;
      ASSERT_EQ(kept[i].position, placed[i].position) << "step " << step << ", light " << i;
      ASSERT_EQ(kept[i].direction, placed[i].direction) << "step " << step << ", light " << i;
      ASSERT_EQ(kept[i].light.intensity, placed[i].light.intensity) << "step " << step << ", light " << i;
    }
    auto expected = std::make_unique<VisibleLights>();
    for (const RenderView& view : views) {
      const auto& visible = world.view_resource<VisibleLights>(view.id);
      expected->wide_highlights = visible.wide_highlights;
      select_lights(placed, view, *expected);
      ASSERT_EQ(visible.local_entities, expected->local_entities) << "step " << step;
      ASSERT_EQ(visible.directional_entities, expected->directional_entities) << "step " << step;
      ASSERT_EQ(visible.block.local_count, expected->block.local_count);
      ASSERT_EQ(visible.block.directional_count, expected->block.directional_count);
      ASSERT_EQ(std::memcmp(visible.block.local, expected->block.local,
                            sizeof(shaders::LocalLight) * visible.block.local_count),
                0)
          << "step " << step;
      ASSERT_EQ(std::memcmp(visible.block.directional, expected->block.directional,
                            sizeof(shaders::DirectionalLight) * visible.block.directional_count),
                0)
          << "step " << step;
      ASSERT_EQ(visible.total, expected->total);
      ASSERT_EQ(visible.dropped, expected->dropped);
    }
  }
};

TEST(LightChangesHard, leave_the_lights_as_they_are_when_made_anew) {
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    ChangingWorld changing(seed, seed % 3 == 0 ? make_pool_executor(4) : make_shuffled_executor(seed));
    for (int i = 0; i < (seed % 4 == 3 ? 700 : 60); ++i) changing.create();
    for (int step = 0; step < 60; ++step) {
      for (int changes = changing.random.index(4); changes > 0; --changes) changing.change();
      changing.run();
      ASSERT_NO_FATAL_FAILURE(changing.expect_as_made_anew(step)) << "seed " << seed;
    }
  }
}

TEST(LightChangesHard, of_one_world_do_not_reach_another_that_is_run_in_turn) {
  ChangingWorld a(100, make_serial_executor());
  ChangingWorld b(101, make_serial_executor());
  // One module and schedule for both worlds, as in a renderer.
  for (int i = 0; i < 40; ++i) a.create();
  for (int i = 0; i < 33; ++i) b.create();
  for (int step = 0; step < 40; ++step) {
    for (ChangingWorld* world : {&a, &b}) {
      for (int changes = world->random.index(3); changes > 0; --changes) world->change();
      a.schedule.run(Stage::world, world->world, *a.executor);
      for (const RenderView& view : world->views) {
        world->world.set_view_resource(view.id, view);
        a.module->prepare_view(world->world, view.id, a.knobs);
        a.schedule.run_view(view.id, world->world, *a.executor);
      }
      ASSERT_NO_FATAL_FAILURE(world->expect_as_made_anew(step));
    }
  }
}

/// In every view, the depths of a light must cover the view depths of everything it lights, and the masks must be built
/// from the same lights.
TEST(LightChangesHard, of_cameras_leave_depths_that_hold_what_lights_light) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SceneRandom random(seed);
    const RenderView view = test::draw_view(random);
    std::vector<PlacedLight> placed;
    for (std::uint32_t i = 0; i < 100; ++i) {
      const MaskLight mask = test::draw_mask_light(random, view);
      PlacedLight light;
      light.entity = {i, 1};
      light.light.range_m = std::max(mask.range_m, 1e-3f);
      light.light.intensity = 5.0f;
      if (mask.cos_outer > -1.0f) {
        light.light.kind = LightKind::spot;
        light.light.outer_angle = std::acos(mask.cos_outer);
      }
      light.position = view.position + dvec3(mask.apex);
      light.direction = mask.direction;
      placed.push_back(light);
    }
    auto visible = std::make_unique<VisibleLights>();
    select_lights(placed, view, *visible);
    ASSERT_EQ(visible->depths.size(), visible->block.local_count);
    ASSERT_EQ(visible->mask_lights.size(), visible->block.local_count);
    const dvec3 forward = -dvec3(glm::transpose(dmat4(view.view_from_relative))[2]);
    float before = 0.0f;
    for (std::uint32_t i = 0; i < visible->block.local_count; ++i) {
      const LightDepth& depth = visible->depths[i];
      ASSERT_GE(depth.nearest, before) << "depths are the order of the lights";
      before = depth.nearest;
      ASSERT_GE(depth.nearest, view.near_m);
      ASSERT_GE(depth.farthest, depth.nearest);
      const PlacedLight& light = placed[visible->local_entities[i].index];
      MaskLight lit =
          light.light.kind == LightKind::spot
              ? test::spot_mask_light(light.position - view.position, dvec3(light.direction),
                                      static_cast<double>(light.light.outer_angle),
                                      static_cast<double>(light.light.range_m))
              : test::point_mask_light(light.position - view.position, static_cast<double>(light.light.range_m));
      const MaskLight& mask = visible->mask_lights[i];
      ASSERT_EQ(mask.apex, visible->block.local[i].position);
      test::sample_light(lit, view, random, 24, [&](const dvec3& point) {
        const double at = glm::dot(forward, point);
        const double rounding = 1e-7 * (glm::length(point) + static_cast<double>(lit.range_m));
        ASSERT_LE(at, static_cast<double>(depth.farthest) + rounding) << "seed " << seed << ", light " << i;
        if (at > static_cast<double>(view.near_m)) {
          ASSERT_GE(at, static_cast<double>(depth.nearest) - rounding) << "seed " << seed << ", light " << i;
        }
        ASSERT_LE(glm::length(point - dvec3(mask.bounds.center)),
                  static_cast<double>(mask.bounds.radius) + 2.0 * rounding)
            << "seed " << seed << ", light " << i;
      });
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace gloam
