// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "engine/core/hash.h"
#include "modules/lights/module.h"
#include "tests/jobs/executors.h"
#include "tests/modules/lights/masks/mask_oracle.h"
#include "tests/support/module_world.h"

namespace gloam {
namespace {

/// A world with lights in two archetypes and one view.
struct LightWorld : test::ModuleWorld {
  std::vector<Entity> entities;

  explicit LightWorld(std::uint32_t count, std::uint32_t seed = 1) : ModuleWorld(make_lights_module()) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      Light light;
      light.kind = i % 2 == 0 ? LightKind::point : LightKind::spot;
      light.range_m = static_cast<float>(2.0 + 1.5 * unit(random));
      light.intensity = static_cast<float>(20.0 + 19.0 * unit(random));
      light.outer_angle = static_cast<float>(0.8 + 0.7 * unit(random));
      const double depth = 30.0 + 29.0 * unit(random);
      const dmat4 placed =
          glm::translate(dmat4(1.0), dvec3(0.7 * depth * unit(random), 0.4 * depth * unit(random), -depth));
      const WorldTransform transform{
          glm::rotate(placed, unit(random) * 3.0, glm::normalize(dvec3(unit(random), 1.1, unit(random))))};
      entities.push_back(i % 3 == 0 ? world.create(light, transform, Parent{}) : world.create(light, transform));
    }
  }

  [[nodiscard]] const LightSet& set() const { return world.resource<LightSet>(); }
  [[nodiscard]] const VisibleLights& visible() const { return world.view_resource<VisibleLights>(settings.id); }
  [[nodiscard]] const ZBins& bins() const { return world.view_resource<ZBins>(settings.id); }
  [[nodiscard]] const TileLightMasks& masks() const { return world.view_resource<TileLightMasks>(settings.id); }

  /// Hash of everything that reaches the GPU.
  [[nodiscard]] std::uint64_t hash() const {
    Hasher hasher;
    const VisibleLights& v = visible();
    hasher.bytes(std::as_bytes(std::span(v.block.local).first(v.block.local_count)));
    hasher.bytes(std::as_bytes(std::span(v.depths)));
    hasher.bytes(std::as_bytes(std::span(v.mask_lights)));
    for (const Entity e : v.local_entities) hasher.value(e.index);
    for (const ZBin& bin : bins().bins) hasher.value(bin.begin).value(bin.end);
    for (const std::uint32_t word : test::meant_words(masks())) hasher.value(word);
    return hasher.digest();
  }
};

TEST(LightReach, a_light_without_a_range_ends_where_no_exposure_shows_it) {
  LightWorld lit(2);
  Light lamp;
  lamp.intensity = 4.0f;
  const Entity endless = lit.world.create(lamp, WorldTransform{});
  auto& environment = lit.world.resource<SceneEnvironment>();
  const auto reach = [&] {
    lit.run();
    return static_cast<double>(effective_range(lit.world.get<Light>(endless)));
  };
  const float ranged = lit.world.get<Light>(lit.entities[0]).range_m;
  EXPECT_NEAR(reach(), 2000.0, 1e-2);
  for (const float ev : {-20.0f, -10.0f, 0.0f, 12.0f, 20.0f, 100.0f}) {
    environment.has_exposure = true;
    environment.exposure_ev100 = ev;
    const double metres = reach(), white = 1.2 * std::exp2(static_cast<double>(ev));  // cd/m²
    const double shown = 4.0 / (metres * metres) / 3.14159265 / white;  // of a white surface at the end, linear
    EXPECT_LT(shown, 1.0 / (255.0 * 12.92 * 2.0) / 3.5) << "half of the darkest step is 3.5 times as bright: " << ev;
    if (ev > -10.0f && ev < 20.0f) {
      EXPECT_GT(shown, 1.0 / (255.0 * 12.92 * 2.0) / 8.0) << "lists stay small: " << ev;
    }
  }
  EXPECT_EQ(lit.world.get<Light>(lit.entities[0]).range_m, ranged);
  EXPECT_EQ(lit.world.get<Light>(lit.entities[0]).unseen_lux, kUnseenLux);
  const std::uint64_t version = lit.set().version;
  (void)reach();
  EXPECT_EQ(lit.set().version, version) << "nothing changed";
  environment.exposure_ev100 = 12.0f;
  lit.world.set_resource(MeteredInEveryFrame{});
  EXPECT_NEAR(reach(), 2000.0, 1e-2) << "the exposure is not known";
  lit.world.remove_resource<MeteredInEveryFrame>();
  environment.has_exposure = false;
  EXPECT_NEAR(reach(), 2000.0, 1e-2);
}

TEST(LightSystems, have_their_names) {
  LightWorld lit(1);
  const std::string text = lit.schedule.describe();
  for (const char* name : {"light_bounds", "light_sort", "zbin_build", "tile_light_masks"})
    EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(LightSystems, add_bounds_to_lights_and_keep_them) {
  LightWorld lit(60);
  lit.run();
  const auto expect_bounds = [&] {
    for (const Entity e : lit.entities) {
      const LightBounds* bounds = lit.world.try_get<LightBounds>(e);
      ASSERT_NE(bounds, nullptr);
      const PlacedLight placed = place_light(e, lit.world.get<Light>(e), lit.world.get<WorldTransform>(e).matrix);
      const Sphere sphere = light_bounds(placed, dvec3(0.0));
      EXPECT_LT(glm::length(bounds->center - dvec3(sphere.center)), 1e-5);
      EXPECT_NEAR(bounds->radius_m, sphere.radius, 1e-5f);
    }
  };
  expect_bounds();
  lit.world.get<WorldTransform>(lit.entities[7]).matrix[3] += dvec4(1.0, 2.0, 3.0, 0.0);
  lit.world.get<Light>(lit.entities[9]).range_m = 11.0f;
  lit.run();
  expect_bounds();
}

TEST(LightSystems, update_only_what_changed) {
  LightWorld lit(90);
  lit.run();
  EXPECT_EQ(lit.set().updated, 90u);
  lit.run();  // the bounds were added by commands: rows moved between archetypes, but no light changed
  EXPECT_EQ(lit.set().updated, 0u);
  lit.run();
  EXPECT_EQ(lit.set().updated, 0u);

  lit.world.get<Light>(lit.entities[4]).intensity *= 2.0f;
  lit.world.get<WorldTransform>(lit.entities[5]).matrix[3].x += 0.25;
  lit.world.get<WorldTransform>(lit.entities[6]).matrix =
      glm::rotate(lit.world.get<WorldTransform>(lit.entities[6]).matrix, 0.1, dvec3(1.0, 0.0, 0.0));
  lit.run();
  EXPECT_EQ(lit.set().updated, 3u);

  lit.world.destroy(lit.entities[10]);
  lit.run();
  EXPECT_EQ(lit.set().updated, 0u) << "others are what they were";
  EXPECT_EQ(lit.set().lights.size(), 89u);
}

TEST(LightSystems, mark_changed_bounds_and_no_others) {
  LightWorld lit(10);
  lit.run();
  lit.run();
  const auto changed = [&](Tick since) {
    std::size_t rows = 0;
    static_cast<void>(lit.world.view<const LightBounds>().changed_since<const LightBounds>(
        since, [&](std::span<const LightBounds> range) { rows += range.size(); }));
    return rows;
  };
  const Tick before = lit.world.advance_tick();
  lit.run();
  EXPECT_EQ(changed(before), 0u);
  lit.world.get<WorldTransform>(lit.entities[1]).matrix[3].y += 1.0;
  lit.run();
  EXPECT_GT(changed(before), 0u);
}

TEST(LightSystems, make_nothing_anew_without_a_change) {
  LightWorld lit(50);
  lit.run();
  lit.run();
  const std::uint64_t version = lit.visible().version;
  const std::uint64_t hash = lit.hash();
  // Data that is not rewritten keeps these marks.
  auto& masks = lit.world.view_resource<TileLightMasks>(lit.settings.id);
  auto& bins = lit.world.view_resource<ZBins>(lit.settings.id);
  const std::uint32_t word = masks.words[0];
  const ZBin bin = bins.bins[0];
  masks.words[0] = 0xABCDEF01u;
  bins.bins[0] = {123, 45};
  lit.run();
  EXPECT_EQ(lit.visible().version, version);
  EXPECT_EQ(masks.words[0], 0xABCDEF01u);
  EXPECT_EQ(bins.bins[0], (ZBin{123, 45}));
  masks.words[0] = word;
  bins.bins[0] = bin;
  EXPECT_EQ(lit.hash(), hash);

  lit.settings.world_from_camera[3].x += 0.5;
  lit.run();
  EXPECT_NE(lit.visible().version, version);
  EXPECT_NE(lit.hash(), hash);
}

TEST(LightSystems, follow_each_part_of_the_camera_and_of_the_settings) {
  LightWorld lit(200);
  lit.run();
  std::uint64_t before = lit.hash();
  const auto expect_change = [&](const char* what) {
    lit.run();
    EXPECT_NE(lit.hash(), before) << what;
    before = lit.hash();
  };
  lit.settings.world_from_camera = glm::rotate(lit.settings.world_from_camera, 0.2, dvec3(0.0, 1.0, 0.0));
  expect_change("turned");
  lit.settings.camera.fov_y *= 1.2f;
  expect_change("lens");
  lit.settings.camera.near_m = 5.0f;
  expect_change("near plane");
  lit.settings.height = 390;
  expect_change("size");
  lit.settings.camera.orthographic = true;
  lit.settings.camera.half_height_m = 12.0f;
  expect_change("projection");
  lit.settings.camera.orthographic = false;
  expect_change("projection back");
  ASSERT_TRUE(lit.knobs.set("lights.tile_bound", "rect").ok());
  expect_change("bound");
  ASSERT_TRUE(lit.knobs.set("lights.z_bins", "256").ok());
  expect_change("number of bins");
  EXPECT_EQ(lit.bins().params.count, 256u);
  lit.world.view_resource<ZBinSettings>(lit.settings.id).farthest_opaque_m = 20.0f;
  expect_change("farthest surface");
  EXPECT_EQ(lit.bins().params.far_m, 20.0f);
}

TEST(LightSystems, end_bins_at_the_last_light_when_no_surface_is_known_or_all_are_farther) {
  LightWorld lit(40);
  lit.run();
  float farthest = 0.0f;
  for (const LightDepth& depth : lit.visible().depths) farthest = std::max(farthest, depth.farthest);
  EXPECT_EQ(lit.bins().params.far_m, farthest);
  lit.world.view_resource<ZBinSettings>(lit.settings.id).farthest_opaque_m = 5000.0f;
  lit.run();
  EXPECT_EQ(lit.bins().params.far_m, farthest);
  EXPECT_EQ(lit.bins().params.near_m, lit.settings.camera.near_m);
}

TEST(LightSystems, have_empty_bins_and_masks_without_a_light) {
  LightWorld lit(0);
  lit.run();
  EXPECT_GT(lit.bins().params.far_m, lit.bins().params.near_m);
  for (const ZBin& bin : lit.bins().bins) EXPECT_EQ(bin, ZBin{});
  EXPECT_EQ(lit.masks().tiles, mask_tiles_of(640, 360));
  for (const std::uint32_t word : test::meant_words(lit.masks())) EXPECT_EQ(word, 0u);
}

TEST(LightSystems, order_depths_and_mask_lights_as_the_block) {
  LightWorld lit(300);
  lit.run();
  const VisibleLights& v = lit.visible();
  ASSERT_GT(v.block.local_count, 20u);
  ASSERT_EQ(v.depths.size(), v.block.local_count);
  ASSERT_EQ(v.mask_lights.size(), v.block.local_count);
  for (std::uint32_t i = 0; i < v.block.local_count; ++i) {
    EXPECT_EQ(v.mask_lights[i].apex, v.block.local[i].position);
    EXPECT_EQ(v.mask_lights[i].direction, v.block.local[i].direction);
    const Light& light = lit.world.get<Light>(v.local_entities[i]);
    EXPECT_EQ(v.mask_lights[i].range_m, light.range_m);
    EXPECT_EQ(v.mask_lights[i].cos_outer > -1.0f, light.kind == LightKind::spot);
    EXPECT_LE(v.depths[i].nearest, v.depths[i].farthest);
    EXPECT_LE(v.depths[i == 0 ? 0 : i - 1].nearest, v.depths[i].nearest);
  }
}

TEST(LightSystems, make_the_same_lists_with_every_executor) {
  for (const char* bound : {"rect", "row_interval", "cone"}) {
    LightWorld expected(1500);
    ASSERT_TRUE(expected.knobs.set("lights.tile_bound", bound).ok());
    expected.run();
    for (const test::ExecutorCase& c : test::all_executors()) {
      LightWorld lit(1500);
      ASSERT_TRUE(lit.knobs.set("lights.tile_bound", bound).ok());
      const auto executor = c.make();
      for (int frame = 0; frame < 3; ++frame) lit.run(*executor);
      EXPECT_EQ(lit.hash(), expected.hash()) << c.name << ", " << bound;
    }
  }
}

}  // namespace
}  // namespace gloam
