// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "engine/schedule/schedule.h"
#include "modules/grass/field/entities.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/lod/visible_patches.h"
#include "modules/grass/module.h"
#include "modules/grass/simulation/colliders.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"
#include "tests/support/worse.h"

// Surfaces that move. The oracle of a blade's place is the ground's matrix in double precision.

namespace gloam {
namespace {

struct GroundWorld {
  World world;
  Schedule schedule;
  std::unique_ptr<JobExecutor> jobs = make_serial_executor();

  GroundWorld() {
    prepare_scene_world(world);
    make_grass_module()->register_components(world);
    world.resource<SceneAssets>().meshes.push_back(test::lawn(4, 10.0f, &test::hills));
    schedule.add_system("grass_growth", "grass", Stage::world, &grass_growth_system);
    schedule.set_checked(true);
  }
  Entity add(float density, const dmat4& matrix) {
    GrassSurface surface;
    surface.density = density;
    return world.create(surface, MeshInstance{0}, WorldTransform{matrix});
  }
  void put(Entity entity, const dmat4& matrix) { world.get<WorldTransform>(entity).matrix = matrix; }
  const GrassField& run(double dt_s = 1.0 / 60.0) {
    world.resource<SceneClock>().time_s += dt_s;
    schedule.run(Stage::world, world, *jobs);
    return world.resource<GrassField>();
  }
};

dmat4 shifted(const dvec3& by) { return glm::translate(dmat4(1.0), by); }
dmat4 turned(const dmat4& m, double angle, const dvec3& axis) { return glm::rotate(m, angle, axis); }

/// Numbers of the growth of each planting.
std::vector<std::uint64_t> numbers(const GrassField& field) {
  std::vector<std::uint64_t> found;
  for (const GrassPlanting& planting : field.plantings) found.push_back(planting.number);
  return found;
}

dvec3 root_of(const GrassField& field, std::size_t slot) {
  const GrassPatch& patch = field.patches[slot / 256];
  return patch.origin + patch.turn * dvec3(field.blades[slot].root_m);
}

/// Greatest distance between the roots and the places to which the ground's matrix has carried them.
double worst_distance(const GrassField& planted, const dmat4& before, const GrassField& now, const dmat4& after) {
  const dmat4 carry = after * glm::inverse(before);
  double worst = 0.0;
  for (std::size_t slot = 0; slot < planted.blades.size(); ++slot) {
    if (planted.blades[slot].length_m <= 0.0f) continue;
    const dvec3 expected(carry * dvec4(root_of(planted, slot), 1.0));
    worst = test::worse(worst, glm::length(root_of(now, slot) - expected));
  }
  return worst;
}

TEST(MovingGround, roots_and_normals_follow_every_rigid_motion_without_new_growth) {
  const dmat4 start = turned(shifted({3.0, -1.0, 2.0}), 0.3, dvec3(0.0, 1.0, 0.0));
  for (const dvec3 axis : {dvec3(0, 1, 0), dvec3(1, 0, 0), dvec3(0.6, 0.0, -0.8), dvec3(0.48, 0.6, 0.64)})
    for (const double angle : {1e-6, 0.01, 1.0, 2.5, 3.14159265358979, -1.57})
      for (const dvec3 way : {dvec3(0.0), dvec3(0.1, 20.0, -3.0), dvec3(1e5, 0.0, -1e5)}) {
        GroundWorld w;
        const Entity ground = w.add(10.0f, start);
        const GrassField planted = w.run();
        const dmat4 now = turned(shifted(way) * start, angle, axis);
        w.put(ground, now);
        const GrassField& field = w.run();
        EXPECT_EQ(field.version, planted.version);
        EXPECT_LT(worst_distance(planted, start, field, now), 1e-5 + 1e-10 * glm::length(way));
        const dvec3 up(planted.blades[0].ground_normal);
        const dvec3 expected(now * glm::inverse(start) * dvec4(up, 0.0));
        EXPECT_LT(glm::length(field.patches[0].turn * up - expected), 1e-6);
      }
}

TEST(MovingGround, a_long_flight_of_small_steps_does_not_drift) {
  GroundWorld w;
  const dmat4 start = shifted({1.0, 2.0, 3.0});
  const Entity ground = w.add(5.0f, start);
  const GrassField planted = w.run();
  dmat4 now = start;
  for (int i = 1; i <= 2000; ++i) {
    now = turned(shifted({0.01 * i, std::sin(0.02 * i), 0.0}) * start, 0.013 * i, dvec3(0.6, 0.8, 0.0));
    w.put(ground, now);
    w.run();
  }
  EXPECT_LT(worst_distance(planted, start, w.run(), now), 1e-5);
}

TEST(MovingGround, only_the_surface_that_changes_is_planted_anew) {
  GroundWorld w;
  const Entity a = w.add(20.0f, shifted({0.0, 0.0, 0.0}));
  const Entity b = w.add(30.0f, shifted({20.0, 0.0, 0.0}));
  const Entity c = w.add(10.0f, shifted({40.0, 0.0, 0.0}));
  std::vector<std::uint64_t> before = numbers(w.run());
  ASSERT_EQ(before.size(), 3u);
  const GrassField first = w.run();
  const auto expect_new = [&](std::size_t changed, const char* why) {
    const std::vector<std::uint64_t> now = numbers(w.run());
    ASSERT_EQ(now.size(), before.size()) << why;
    for (std::size_t i = 0; i < now.size(); ++i) EXPECT_EQ(now[i] != before[i], i == changed) << why << " " << i;
    before = now;
  };
  w.put(a, turned(dmat4(1.0), 0.1, dvec3(0.0, 1.0, 0.0)));
  expect_new(~std::size_t{0}, "a turn");
  w.put(a, glm::scale(dmat4(1.0), dvec3(1.1)));
  expect_new(~std::size_t{0}, "a small stretch");
  w.put(a, glm::scale(dmat4(1.0), dvec3(2.0)));
  expect_new(0, "a great stretch");
  w.put(b, glm::scale(shifted({20.0, 0.0, 0.0}), dvec3(1.0, 1.0, -1.0)));
  expect_new(1, "a mirror");
  w.world.get<GrassSurface>(c).density = 17.0f;
  expect_new(2, "a density");
  // The blades that stayed are the same, in the slots of their patches.
  const GrassField& field = w.run();
  w.put(a, shifted({0.0, 0.0, 0.0}));
  w.put(b, shifted({20.0, 0.0, 0.0}));
  w.world.get<GrassSurface>(c).density = 10.0f;
  w.run();
  EXPECT_EQ(test::hash_of(field.patches, field.blades), test::hash_of(first.patches, first.blades));
  for (std::size_t i = 0; i < field.blades.size(); ++i) {
    ASSERT_EQ(field.blades[i].slot, i);
    ASSERT_EQ(field.blades[i].master / 256, i / 256);
  }
}

TEST(MovingGround, a_surface_less_or_more_keeps_the_others) {
  GroundWorld w;
  const Entity a = w.add(20.0f, dmat4(1.0));
  w.add(30.0f, shifted({20.0, 0.0, 0.0}));
  const std::uint64_t kept = numbers(w.run())[1];
  const std::uint32_t blades = w.run().statistics.blades;
  w.world.destroy(a);
  EXPECT_EQ(numbers(w.run()), std::vector{kept});
  EXPECT_LT(w.run().statistics.blades, blades);
  w.add(20.0f, dmat4(1.0));
  EXPECT_EQ(w.run().statistics.blades, blades);
  EXPECT_EQ(std::ranges::count(numbers(w.run()), kept), 1);
}

TEST(MovingGround, poses_without_an_inverse_or_a_number_grow_once_and_come_back) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  dmat4 flat(1.0), lost(1.0), beyond(1.0);
  flat[1] = dvec4(0.0);
  flat[0] = dvec4(0.0);
  lost[3].x = nan;
  beyond[0].x = infinite;
  for (const dmat4& bad : {flat, lost, beyond}) {
    GroundWorld w;
    const Entity ground = w.add(10.0f, dmat4(1.0));
    const std::uint32_t blades = w.run().statistics.blades;
    w.put(ground, bad);
    const std::uint64_t version = w.run().version;
    EXPECT_EQ(w.run().version, version) << "grown in every frame";
    w.put(ground, dmat4(1.0));
    EXPECT_EQ(w.run().statistics.blades, blades);
  }
}

TEST(MovingGround, the_push_is_the_acceleration_of_the_ground_and_ends_with_it) {
  GroundWorld w;
  const Entity ground = w.add(5.0f, dmat4(1.0));
  const double dt = 1.0 / 60.0;
  w.run(dt);
  for (int i = 1; i <= 30; ++i) {  // x = a t² / 2
    w.put(ground, shifted({0.5 * 4.0 * (i * dt) * (i * dt), 0.0, 0.0}));
    const GrassField& field = w.run(dt);
    if (i < 3) continue;
    for (const GrassPatchMotion& motion : field.motions) {
      ASSERT_NEAR(motion.push.x, -4.0f, 1e-3f) << i;
      ASSERT_NEAR(glm::length(motion.push), 4.0f, 1e-3f);
    }
  }
  w.run(dt);
  EXPECT_GT(w.run(0.0).motions[0].push.x, 1.0f) << "it stops at once; a frame of the same moment changes nothing";
  w.run(dt);
  w.run(dt);
  EXPECT_EQ(w.run(dt).motions[0].push, vec3(0.0f));
  EXPECT_EQ(w.run(dt).motions[0].carried, dvec3(0.0));
  w.put(ground, shifted({1e9, 0.0, 0.0}));
  EXPECT_LE(glm::length(w.run(dt).motions[0].push), 1.001f * static_cast<float>(kMostGroundPush));
}

TEST(MovingGround, a_sequence_that_starts_again_has_the_same_blades_at_the_same_places) {
  GroundWorld w;
  const Entity turning = w.add(5.0f, dmat4(1.0));
  const Entity growing = w.add(5.0f, shifted({20.0, 0.0, 0.0}));
  std::vector<std::vector<dvec3>> runs(2);
  for (std::vector<dvec3>& roots : runs) {
    w.world.resource<SceneClock>().time_s = 0.0;
    for (int i = 0; i < 30; ++i) {
      w.put(turning, turned(dmat4(1.0), 0.1 + 0.1 * i, dvec3(0.0, 0.0, 1.0)));
      w.put(growing, glm::scale(shifted({20.0, 0.0, 0.0}), dvec3(1.0 + 0.05 * i)));
      const GrassField& field = w.run();
      for (std::size_t slot = 0; slot < field.blades.size(); slot += 7) roots.push_back(root_of(field, slot));
    }
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(MovingGround, culling_and_colliders_see_the_turned_patch) {
  GroundWorld w;
  const Entity ground = w.add(10.0f, dmat4(1.0));
  w.run();
  const dmat4 now = turned(shifted({5.0, 3.0, 1.0}), 1.3, glm::normalize(dvec3(1.0, 1.0, 0.3)));
  w.put(ground, now);
  const GrassField& field = w.run();
  for (const GrassPatch& patch : field.patches) {
    const Aabb box = reach_box(patch);
    for (std::uint32_t i = 0; i < patch.blades; ++i) {
      const GrassBlade& blade = field.blades[patch.index * 256 + i];
      const dvec3 tip = root_of(field, blade.slot) +
                        patch.turn * dvec3(blade.ground_normal) * static_cast<double>(blade.length_m) - patch.origin;
      for (int a = 0; a < 3; ++a) {
        ASSERT_GE(tip[a], static_cast<double>(box.min[a]) - 1e-5);
        ASSERT_LE(tip[a], static_cast<double>(box.max[a]) + 1e-5);
      }
    }
    // A small sphere at a blade's tip is found, at its place along the patch's axes.
    const GrassBlade& blade = field.blades[patch.index * 256];
    const dvec3 at = root_of(field, blade.slot) + patch.turn * dvec3(blade.ground_normal) * 0.1;
    Collider sphere{ColliderShape::sphere, 0.05f, 1.0f, vec3(1.0f)};
    const auto placed = place_collider(ground, sphere, shifted(at));
    ASSERT_TRUE(placed.has_value());
    std::vector<shaders::GrassCollider> rows;
    ASSERT_EQ(colliders_near(patch, std::span(&*placed, 1), rows), 1u);
    EXPECT_LT(glm::length(dvec3(rows[0].from) - dvec3(blade.root_m) - dvec3(blade.ground_normal) * 0.1), 1e-5);
  }
}

}  // namespace
}  // namespace gloam
