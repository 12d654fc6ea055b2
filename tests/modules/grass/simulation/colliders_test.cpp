// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/colliders.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <random>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"

namespace gloam::test {
namespace {

dmat4 placed_at(dvec3 at, dvec3 scale = dvec3(1.0), double turn = 0.0) {
  return glm::scale(glm::rotate(glm::translate(dmat4(1.0), at), turn, dvec3(0.3, 0.5, 0.81)), scale);
}

const Collider kSphere{ColliderShape::sphere, 0.5f};
const Collider kCapsule{ColliderShape::capsule, 0.25f, 1.8f};
const Collider kBox{ColliderShape::box, 0.0f, 0.0f, vec3(2.0f, 4.0f, 6.0f)};

PlacedCollider must_place(const Collider& collider, const dmat4& m) {
  const auto placed = place_collider(kNoEntity, collider, m);
  EXPECT_TRUE(placed.has_value());
  return placed.value_or(PlacedCollider{});
}

TEST(GrassColliders, shapes_are_placed_as_their_keys_say) {
  const PlacedCollider sphere = must_place(kSphere, placed_at({1.0, 2.0, 3.0}));
  EXPECT_EQ(sphere.from, dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(sphere.to, sphere.from);
  EXPECT_DOUBLE_EQ(sphere.radius_m, 0.5);
  const PlacedCollider capsule = must_place(kCapsule, placed_at({1.0, 2.0, 3.0}));
  EXPECT_NEAR(capsule.from.y, 2.25, 1e-7) << "the height includes the caps";
  EXPECT_NEAR(capsule.to.y, 3.55, 1e-6);
  const PlacedCollider box = must_place(kBox, placed_at({1.0, 2.0, 3.0}));
  EXPECT_TRUE(box.box);
  EXPECT_EQ(box.from, dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(box.half_size, dvec3(1.0, 2.0, 3.0));
  EXPECT_FALSE(place_collider(kNoEntity, Collider{}, dmat4(1.0)).has_value());
}

TEST(GrassColliders, non_uniform_scale_keeps_capsules_around_and_boxes_exact) {
  const PlacedCollider sphere = must_place(kSphere, placed_at(dvec3(0.0), {1.0, 3.0, 2.0}));
  EXPECT_NEAR(sphere.radius_m, 1.5, 1e-9);
  const PlacedCollider capsule = must_place(kCapsule, placed_at(dvec3(0.0), {2.0, 1.0, 3.0}));
  EXPECT_NEAR(capsule.radius_m, 0.75, 1e-9);
  EXPECT_NEAR(capsule.from.y, 0.75, 1e-6);
  EXPECT_NEAR(capsule.to.y, 1.05, 1e-6);
  const dmat4 turned = placed_at({5.0, 0.0, 0.0}, {2.0, 1.0, 0.5}, 0.7);
  const PlacedCollider box = must_place(kBox, turned);
  EXPECT_NEAR(glm::length(box.half_size - dvec3(2.0, 2.0, 1.5)), 0.0, 1e-9);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(glm::length(box.axes[i]), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(box.axes[i], box.axes[(i + 1) % 3]), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(box.axes[i], glm::normalize(dvec3(turned[i])))), 1.0, 1e-12);
  }
  for (const dvec3 flat : {dvec3(0.0), dvec3(1.0, 0.0, 1.0), dvec3(0.0, 1.0, 0.0), dvec3(-1.0, 1.0, 1.0)})
    for (const Collider& c : {kSphere, kCapsule, kBox}) {
      const PlacedCollider placed = must_place(c, placed_at(dvec3(1.0), flat, 0.2));
      EXPECT_GE(placed.radius_m, 0.0);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::length(placed.axes[i]), 1.0, 1e-9);
    }
}

TEST(GrassColliders, values_that_are_not_finite_place_nothing) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(place_collider(kNoEntity, {ColliderShape::sphere, kNan}, dmat4(1.0)).has_value());
  EXPECT_FALSE(place_collider(kNoEntity, kBox, placed_at(dvec3(std::nan("")))).has_value());
  EXPECT_FALSE(place_collider(kNoEntity, kCapsule, placed_at(dvec3(1e308 * 10.0))).has_value());
}

class GrassColliderSystem : public ::testing::Test {
 protected:
  GrassColliderSystem() {
    world_.register_component<Collider>("collider");
    world_.register_component<WorldTransform>("world_transform");
    register_grass_world_resources(world_);
  }
  Entity add(const Collider& collider, dvec3 at) { return world_.create(collider, WorldTransform{placed_at(at)}); }
  void move(Entity entity, dvec3 at) { world_.get<WorldTransform>(entity).matrix = placed_at(at); }
  const std::vector<PlacedCollider>& frame(double dt_s) {
    world_.resource<StepClock>().advance(dt_s);
    return frame_at_the_same_time();
  }
  const std::vector<PlacedCollider>& frame_at_the_same_time() {
    ++view_.frame;
    grass_colliders_system(View<const Collider, const WorldTransform>(world_), ViewResource<const RenderView>(view_),
                           Resource<const StepClock>(world_.resource<StepClock>()),
                           Resource<const GrassGrowthSettings>(settings_),
                           Resource<GrassColliders>(world_.resource<GrassColliders>()));
    return world_.resource<GrassColliders>().colliders;
  }
  World world_;
  RenderView view_;
  GrassGrowthSettings settings_;
};

TEST_F(GrassColliderSystem, are_in_metres_whatever_a_unit_is) {
  settings_.metres_per_unit = 0.01;
  const Entity entity = add({ColliderShape::sphere, 50.0f}, dvec3(100.0, 200.0, -300.0));
  EXPECT_LT(glm::length(frame(0.01).at(0).from - dvec3(1.0, 2.0, -3.0)), 1e-12);
  EXPECT_NEAR(frame(0.01).at(0).radius_m, 0.5, 1e-12);
  move(entity, dvec3(600.0, 200.0, -300.0));
  EXPECT_LT(glm::length(frame(0.01).at(0).high - dvec3(6.5, 2.5, -2.5)), 1e-12);
}

TEST_F(GrassColliderSystem, the_way_begins_where_the_last_advanced_frame_has_ended) {
  const Entity entity = add(kSphere, dvec3(0.0));
  EXPECT_EQ(frame(0.01).at(0).from_previous, dvec3(0.0)) << "a new collider has been where it is";
  move(entity, dvec3(100.0, 0.0, 0.0));
  const PlacedCollider swept = frame(0.0).at(0);
  EXPECT_EQ(swept.from, dvec3(100.0, 0.0, 0.0));
  EXPECT_EQ(swept.from_previous, dvec3(0.0));
  EXPECT_EQ(swept.low, dvec3(-0.5));
  EXPECT_EQ(swept.high, dvec3(100.5, 0.5, 0.5));
  move(entity, dvec3(101.0, 0.0, 0.0));
  EXPECT_EQ(frame(0.1).at(0).from_previous, dvec3(0.0)) << "the frame before has not advanced the grass";
  EXPECT_EQ(frame(0.1).at(0).from_previous, dvec3(101.0, 0.0, 0.0));
}

TEST_F(GrassColliderSystem, a_frame_at_the_same_time_repeats_the_way) {
  const Entity entity = add(kSphere, dvec3(0.0));
  frame(0.1);
  move(entity, dvec3(1.0, 0.0, 0.0));
  for (int i = 0; i < 3; ++i) {
    const PlacedCollider swept = i == 0 ? frame(0.1).at(0) : frame_at_the_same_time().at(0);
    EXPECT_EQ(swept.from_previous, dvec3(0.0)) << i;
    EXPECT_EQ(swept.from, dvec3(1.0, 0.0, 0.0)) << i;
  }
  EXPECT_EQ(frame(0.1).at(0).from_previous, dvec3(1.0, 0.0, 0.0));
}

// Hard case: further.time_backwards
TEST_F(GrassColliderSystem, after_a_restart_colliders_have_been_where_they_are) {
  const Entity entity = add(kSphere, dvec3(0.0));
  frame(0.1);
  move(entity, dvec3(1.0, 0.0, 0.0));
  world_.resource<StepClock>().restart(0);
  EXPECT_EQ(frame(0.1).at(0).from_previous, dvec3(1.0, 0.0, 0.0));
}

TEST_F(GrassColliderSystem, colliders_come_in_the_order_of_their_entities_and_leave_with_them) {
  const Entity first = add(kSphere, dvec3(1.0));
  const Entity second = add(kBox, dvec3(2.0));
  add({}, dvec3(3.0));
  ASSERT_EQ(frame(0.1).size(), 2u);
  EXPECT_EQ(frame(0.1).at(0).entity, first);
  world_.destroy(first);
  add(kCapsule, dvec3(4.0));
  const std::vector<PlacedCollider>& found = frame(0.1);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT(found[0].entity.index, found[1].entity.index);
  for (const PlacedCollider& c : found) EXPECT_EQ(c.from, c.from_previous);
  EXPECT_TRUE(found[0].entity == second || found[1].entity == second);
}

/// Whether a point of the patch's blades may be inside the collider at some time of its way.
bool meets(const GrassPatch& patch, const PlacedCollider& c, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto reach = static_cast<double>(patch.reach_m);
  for (int i = 0; i < 400; ++i) {
    const dvec3 share(unit(random), unit(random), unit(random));
    const dvec3 root = dvec3(patch.roots.min) + share * dvec3(patch.roots.max - patch.roots.min);
    dvec3 way(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    way *= reach * unit(random) / glm::length(way);
    const dvec3 at = patch.origin + root + way;
    const double passed = unit(random);
    const dvec3 from = glm::mix(c.from_previous, c.from, passed);
    const dvec3 to = glm::mix(c.to_previous, c.to, passed);
    if (c.box) {
      bool inside = true;
      for (int a = 0; a < 3; ++a) inside = inside && std::abs(glm::dot(c.axes[a], at - from)) < c.half_size[a];
      if (inside) return true;
      continue;
    }
    const dvec3 axis = to - from;
    const double along = std::clamp(glm::dot(at - from, axis) / std::max(glm::dot(axis, axis), 1e-12), 0.0, 1.0);
    if (glm::length(at - from - along * axis) < c.radius_m) return true;
  }
  return false;
}

TEST(GrassCollidersNear, no_collider_that_touches_a_blade_is_left_out) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-4.0, 4.0);
  std::uniform_real_distribution<double> size(0.0, 2.0);
  std::uint32_t met = 0;
  std::uint32_t left_out = 0;
  for (int i = 0; i < 3000; ++i) {
    GrassPatch patch;
    patch.origin = dvec3(1e5, 30.0, -1e5);
    patch.roots.grow(vec3(-1.0f, -0.1f, -0.8f));
    patch.roots.grow(vec3(1.0f, 0.1f, 0.8f));
    patch.reach_m = 0.4f;
    const Collider kinds[] = {{ColliderShape::sphere, static_cast<float>(size(random))},
                              {ColliderShape::capsule, static_cast<float>(0.5 * size(random)), 1.8f},
                              {ColliderShape::box, 0.0f, 0.0f, vec3(static_cast<float>(size(random)), 0.3f, 1.0f)}};
    const Collider& kind = kinds[i % 3];
    const auto pose = [&] {
      return placed_at(patch.origin + dvec3(place(random), 0.3 * place(random), place(random)),
                       dvec3(0.5 + size(random), 1.0, 0.5), place(random));
    };
    const PlacedCollider before = must_place(kind, pose());
    PlacedCollider now = must_place(kind, pose());
    sweep_collider(&before, now);
    std::vector<shaders::GrassCollider> rows;
    const bool near = colliders_near(patch, {&now, 1}, rows) == 1;
    EXPECT_EQ(rows.size(), near ? 1u : 0u);
    left_out += near ? 0 : 1;
    if (!meets(patch, now, random)) continue;
    ++met;
    EXPECT_TRUE(near) << i;
  }
  EXPECT_GT(met, 300u);
  EXPECT_GT(left_out, 300u);
}

TEST(GrassCollidersNear, rows_are_relative_to_the_patch) {
  GrassPatch patch;
  patch.origin = dvec3(1e5, 0.0, 1e5);
  patch.roots.grow(vec3(0.0f));
  patch.reach_m = 0.3f;
  const PlacedCollider before = must_place(kCapsule, placed_at(patch.origin + dvec3(-100.0, 0.0, 0.0)));
  std::vector<PlacedCollider> all = {must_place(kCapsule, placed_at(patch.origin + dvec3(0.125, 0.0, 0.0))),
                                     must_place(kSphere, placed_at(patch.origin + dvec3(9.0, 0.0, 0.0))),
                                     must_place(kBox, placed_at(patch.origin + dvec3(0.0, 0.0, 1.0)))};
  sweep_collider(&before, all[0]);
  std::vector<shaders::GrassCollider> rows;
  ASSERT_EQ(colliders_near(patch, all, rows), 2u);
  EXPECT_NEAR(rows[0].from.x, 0.125f, 1e-6f);
  EXPECT_NEAR(rows[0].from_previous.x, -100.0f, 1e-5f);
  EXPECT_EQ(rows[0].box, 0u);
  EXPECT_EQ(rows[1].box, 1u);
  EXPECT_EQ(rows[1].half_size, vec3(1.0f, 2.0f, 3.0f));
  patch.roots = {};
  EXPECT_EQ(colliders_near(patch, all, rows), 0u) << "a patch without blades";
}

// Hard case: grass.collider_large
TEST(GrassCollidersNear, a_collider_larger_than_the_patch_is_near) {
  GrassPatch patch;
  patch.roots.grow(vec3(-1.0f));
  patch.roots.grow(vec3(1.0f));
  std::vector<shaders::GrassCollider> rows;
  const PlacedCollider huge = must_place({ColliderShape::sphere, 1e4f}, placed_at({0.0, -9990.0, 0.0}));
  const PlacedCollider point = must_place({ColliderShape::sphere, 0.0f}, placed_at(dvec3(0.5)));
  EXPECT_EQ(colliders_near(patch, {&huge, 1}, rows), 1u);
  EXPECT_EQ(colliders_near(patch, {&point, 1}, rows), 1u) << "of no radius, but inside";
}

}  // namespace
}  // namespace gloam::test
