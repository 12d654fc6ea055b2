// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/systems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "modules/lights/module.h"
#include "modules/lights/selection/light_list.h"
#include "modules/shadows/components.h"
#include "tests/jobs/executors.h"
#include "tests/modules/closeups/cases.h"
#include "tests/support/module_world.h"

namespace gloam {
namespace {

dmat4 at(double x, double y, double z) { return glm::translate(dmat4(1.0), dvec3(x, y, z)); }

/// A world with lights, close-up subjects and one view. Mesh 0 is a cube of 1 m.
struct CloseupWorld : test::ModuleWorld {
  CloseupWorld() : ModuleWorld(make_lights_module()) {
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<CloseupSubject>("closeup_subject");
    world.register_component<CloseupPair>("closeup_pair");
    register_closeup_resources(world);
    add_closeup_systems(schedule);
    settings.follow_camera = false;
    settings.world_from_camera = at(0, 0, 12);
    auto& assets = world.resource<SceneAssets>();
    assets.meshes.emplace_back();
    assets.meshes[0].bounds = {vec3(-0.5f), vec3(0.5f)};
    prepare_closeup_view(world, settings.id);
  }

  Entity add_subject(const dmat4& node = dmat4(1.0), float priority = 1.0f) {
    return world.create(CloseupSubject{true, priority, 0}, MeshInstance{}, WorldTransform{node});
  }
  Entity add_light(const dmat4& node, LightKind kind = LightKind::point, float range_m = 6.0f) {
    Light light;
    light.kind = kind;
    light.range_m = range_m;
    light.intensity = 10.0f;
    light.width_m = 0.1f;
    return world.create(light, WorldTransform{node});
  }
  using ModuleWorld::run;
  const CloseupViews& run() {
    run(*make_serial_executor());
    return views();
  }
  [[nodiscard]] const CloseupViews& views() const { return world.view_resource<CloseupViews>(settings.id); }
  [[nodiscard]] CloseupSettings& closeup_settings() { return world.view_resource<CloseupSettings>(settings.id); }
  [[nodiscard]] const CloseupSubjects::Subject& subject(Entity entity) const {
    for (const auto& s : world.resource<CloseupSubjects>().subjects)
      if (s.entity == entity) return s;
    static const CloseupSubjects::Subject none;
    return none;
  }
  /// The entity of a pair; kNoEntity if there is none.
  [[nodiscard]] Entity pair(Entity of, Entity light) const {
    Entity found = kNoEntity;
    world.view<const CloseupPair>().each([&](Entity entity, const CloseupPair& p) {
      if (p.subject == of && p.light == light) found = entity;
    });
    return found;
  }
  [[nodiscard]] std::size_t pairs() const { return world.view<const CloseupPair>().size(); }
};

void expect_same(const CloseupViews& a, const CloseupViews& b, bool same_entities) {
  EXPECT_EQ(a.in_view, b.in_view);
  EXPECT_EQ(a.skipped, b.skipped);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    const CloseupView &x = a.pairs[i], &y = b.pairs[i];
    EXPECT_TRUE(!same_entities || x.pair == y.pair);
    EXPECT_EQ(x.subject, y.subject);
    EXPECT_EQ(x.light, y.light);
    EXPECT_EQ(x.light_index, y.light_index);
    EXPECT_EQ(x.subject_index, y.subject_index);
    EXPECT_EQ(x.tiles, y.tiles);
    EXPECT_EQ(x.coverage, y.coverage);
    EXPECT_EQ(x.face.origin, y.face.origin);
    EXPECT_EQ(x.face.right, y.face.right);
    EXPECT_EQ(x.face.forward, y.face.forward);
    EXPECT_EQ(x.face.tan_half, y.face.tan_half);
    EXPECT_EQ(x.face.half_extent_m, y.face.half_extent_m);
    EXPECT_EQ(x.face.near_m, y.face.near_m);
    EXPECT_EQ(x.face.far_m, y.face.far_m);
    EXPECT_EQ(x.face.square, y.face.square);
    EXPECT_EQ(x.tan_inner, y.tan_inner);
  }
}

TEST(CloseupSystems, the_innermost_enabled_subject_has_the_mesh) {
  CloseupWorld w;
  const Entity outer = w.add_subject();
  const Entity node = w.world.create(Parent{outer, 1}, WorldTransform{});
  const Entity inner =
      w.world.create(CloseupSubject{true, 1.0f, 0}, MeshInstance{}, WorldTransform{at(3, 0, 0)}, Parent{node, 2});
  const Entity off =
      w.world.create(CloseupSubject{false, 1.0f, 0}, MeshInstance{}, WorldTransform{at(0, 2, 0)}, Parent{node, 2});
  const Entity leaf = w.world.create(MeshInstance{}, WorldTransform{at(4, 0, 0)}, Parent{inner, 3});
  const Entity stranger = w.world.create(MeshInstance{}, WorldTransform{at(-9, 0, 0)});
  w.run();
  EXPECT_THAT(w.subject(outer).casters, ::testing::UnorderedElementsAre(outer, off));
  EXPECT_THAT(w.subject(inner).casters, ::testing::UnorderedElementsAre(inner, leaf));
  EXPECT_EQ(w.subject(off).entity, kNoEntity) << "not enabled, not listed; nor is " << stranger.index;
  EXPECT_EQ(w.subject(outer).low, dvec3(-0.5));
  EXPECT_EQ(w.subject(outer).high, dvec3(0.5, 2.5, 0.5));
  EXPECT_EQ(w.subject(inner).low, dvec3(2.5, -0.5, -0.5));
  EXPECT_EQ(w.subject(inner).high, dvec3(4.5, 0.5, 0.5));
}

TEST(CloseupSystems, a_ring_of_parents_ends) {
  CloseupWorld w;
  w.add_subject();
  const Entity a = w.world.create(MeshInstance{}, WorldTransform{});
  const Entity b = w.world.create(WorldTransform{}, Parent{a, 1});
  w.world.add(a, Parent{b, 1});
  w.run();
  EXPECT_EQ(w.world.resource<CloseupSubjects>().subjects[0].casters.size(), 1u);
}

/// Two bars, each skinned to a different joint.
void add_skinned_mesh(SceneAssets& assets) {
  Mesh mesh;
  Primitive& p = mesh.primitives.emplace_back();
  for (int i = 0; i < 16; ++i) {
    const std::uint16_t joint = i < 8 ? 0 : 1;
    p.positions.emplace_back((i & 1 ? 0.1f : -0.1f), (i & 2 ? 1.0f : 0.0f) + joint, (i & 4 ? 0.1f : -0.1f));
    p.joints.push_back({joint, 0, 0, 0});
    p.weights.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
    p.bounds.grow(p.positions.back());
  }
  p.indices = {0, 1, 2};
  p.morph_targets.emplace_back().positions.assign(16, vec3(0.0f, 0.0f, 2.0f));
  mesh.bounds = p.bounds;
  assets.meshes.push_back(mesh);
  ++assets.version;
}

TEST(CloseupSystems, a_skinned_subjects_box_follows_the_pose_and_is_tight) {
  CloseupWorld w;
  add_skinned_mesh(w.world.resource<SceneAssets>());
  const Entity entity = w.world.create(CloseupSubject{true, 1.0f, 0}, MeshInstance{1, 0}, MorphInstance{0, 1},
                                       WorldTransform{at(99, 0, 0)});
  auto& weights = w.world.resource<MorphWeights>();
  weights.values = {0.0f};
  auto& joints = w.world.resource<JointMatrices>();
  joints.ranges.push_back({entity, 0, 2, dvec3(10.0, 0.0, 0.0), false});
  joints.matrices = {mat4(1.0f), glm::translate(mat4(1.0f), vec3(3.0f, -1.0f, 0.0f))};
  w.run();
  const auto near = [](const dvec3& a, const dvec3& b) { return glm::length(a - b) < 1e-5; };
  EXPECT_TRUE(near(w.subject(entity).low, dvec3(9.9, 0.0, -0.1))) << "joint by joint, not by its node";
  EXPECT_TRUE(near(w.subject(entity).high, dvec3(13.1, 1.0, 0.1)));
  joints.matrices[1] = glm::translate(mat4(1.0f), vec3(0.0f, 4.0f, 0.0f));
  weights.values = {-0.5f};
  w.run();
  EXPECT_TRUE(near(w.subject(entity).low, dvec3(9.9, 0.0, -1.1))) << "moved by its morph target";
  EXPECT_TRUE(near(w.subject(entity).high, dvec3(10.1, 6.0, -0.9)));
}

TEST(CloseupSystems, a_subject_that_may_be_anywhere_has_no_pairs) {
  CloseupWorld w;
  add_skinned_mesh(w.world.resource<SceneAssets>());
  const Entity entity = w.world.create(CloseupSubject{true, 1.0f, 0}, MeshInstance{1, 0}, WorldTransform{});
  w.add_light(at(0, 3, 0));
  w.add_light(at(0, 3, 0), LightKind::directional);
  w.run();
  EXPECT_EQ(w.pairs(), 2u);
  auto& joints = w.world.resource<JointMatrices>();
  joints.ranges.push_back({entity, 0, 1, dvec3(0.0), false});
  joints.matrices = {mat4(1.0f)};
  w.run();
  EXPECT_FALSE(w.subject(entity).known()) << "a joint is missing";
  EXPECT_EQ(w.pairs(), 0u);
  const Entity lost = w.add_subject(at(std::nan(""), 0, 0));
  w.run();
  EXPECT_FALSE(w.subject(lost).known());
  EXPECT_EQ(w.pairs(), 0u);
  w.world.create(CloseupSubject{true, 1.0f, 0}, WorldTransform{});
  w.run();
  EXPECT_EQ(w.pairs(), 0u) << "nothing to see";
}

TEST(CloseupSystems, pairs_come_and_go_with_the_lights_reach_and_keep_their_entities) {
  CloseupWorld w;
  const Entity subject = w.add_subject();
  const Entity stays = w.add_light(at(0, 3, 0));
  const Entity moves = w.add_light(at(4, 0, 0));
  w.run();
  EXPECT_EQ(w.pairs(), 2u) << "in the first frame";
  const Entity kept = w.pair(subject, stays);
  w.world.get<WorldTransform>(moves).matrix = at(20, 0, 0);
  w.run();
  EXPECT_EQ(w.pairs(), 1u);
  EXPECT_EQ(w.pair(subject, moves), kNoEntity);
  w.world.get<WorldTransform>(moves).matrix = at(-6.4, 0, 0);
  w.run();
  EXPECT_NE(w.pair(subject, moves), kNoEntity) << "its sphere touches the box";
  w.world.get<WorldTransform>(moves).matrix = at(-6.6, 0, 0);
  w.run();
  EXPECT_EQ(w.pair(subject, moves), kNoEntity);
  EXPECT_EQ(w.pair(subject, stays), kept);
  w.world.get<CloseupSubject>(subject).enabled = false;
  w.run();
  EXPECT_EQ(w.pairs(), 0u);
}

TEST(CloseupSystems, lights_that_cast_no_shadow_have_no_pairs) {
  CloseupWorld w;
  const Entity subject = w.add_subject();
  w.world.add(w.add_light(at(0, 3, 0)), ShadowCaster{false, 0});
  w.world.get<Light>(w.add_light(at(0, 3, 0))).intensity = 0.0f;
  w.world.get<Light>(w.add_light(at(0, 3, 0))).intensity = std::numeric_limits<float>::quiet_NaN();
  w.add_light(at(0.6, 0, 0), LightKind::point, 0.04f);
  w.add_light(at(std::nan(""), 0, 0));
  w.run();
  EXPECT_EQ(w.pairs(), 0u);
  const Entity on = w.add_light(at(0, 3, 0));
  w.world.add(on, ShadowCaster{true, 0});
  const Entity sun = w.add_light(at(500, 500, 0), LightKind::directional);
  w.run();
  EXPECT_EQ(w.pairs(), 2u);
  EXPECT_NE(w.pair(subject, on), kNoEntity);
  EXPECT_NE(w.pair(subject, sun), kNoEntity) << "wherever it stands";
}

TEST(CloseupSystems, named_lights_only) {
  CloseupWorld w;
  const Entity subject = w.add_subject();
  const Entity key = w.add_light(at(0, 3, 0));
  const Entity fill = w.add_light(at(0, -3, 0));
  const Entity rim = w.add_light(at(3, 0, 0));
  auto& names = w.world.resource<SceneNames>();
  names.add("light", "key", key);
  names.add("light", "fill", fill);
  names.add("light", "rim", rim);
  w.world.get<CloseupSubject>(subject).lights = w.world.resource<SceneStrings>().intern("rim, key");
  w.run();
  EXPECT_EQ(w.pairs(), 2u);
  EXPECT_EQ(w.pair(subject, fill), kNoEntity);
  w.world.get<CloseupSubject>(subject).lights = w.world.resource<SceneStrings>().intern("fill");
  w.run();
  EXPECT_EQ(w.pairs(), 1u);
  EXPECT_NE(w.pair(subject, fill), kNoEntity);
  w.world.get<CloseupSubject>(subject).lights = w.world.resource<SceneStrings>().intern("nobody");
  w.run();
  EXPECT_EQ(w.pairs(), 0u);
}

/// Subjects and lights of all kinds. `order`: the order in which the lights are created.
void fill(CloseupWorld& w, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 12; ++i)
    w.add_subject(at(4.0 * unit(random), 3.0 * unit(random), 3.0 * unit(random)), static_cast<float>(i % 3));
  for (int i = 0; i < 24; ++i) {
    const LightKind kind = i % 8 == 0 ? LightKind::directional : i % 2 == 0 ? LightKind::point : LightKind::spot;
    const dmat4 node = at(5.0 * unit(random), 4.0 * unit(random), 4.0 * unit(random));
    w.add_light(glm::rotate(node, 3.0 * unit(random), dvec3(1, 0, 0)), kind);
  }
  w.closeup_settings().max_pairs = 40;
}

TEST(CloseupSystems, results_do_not_depend_on_threads) {
  CloseupWorld expected;
  fill(expected, 3);
  expected.run();
  expected.run();
  ASSERT_GT(expected.views().pairs.size(), 20u);
  for (const test::ExecutorCase& executor : test::all_executors()) {
    SCOPED_TRACE(executor.name);
    CloseupWorld w;
    fill(w, 3);
    const auto jobs = executor.make();
    w.run(*jobs);
    w.run(*jobs);
    expect_same(expected.views(), w.views(), true);
  }
}

TEST(CloseupSystems, order_does_not_depend_on_when_pairs_were_made) {
  CloseupWorld together;
  fill(together, 4);
  together.run();
  CloseupWorld one_by_one;
  fill(one_by_one, 4);
  std::vector<Entity> subjects;
  one_by_one.world.view<CloseupSubject>().each([&](Entity e, CloseupSubject& s) {
    subjects.push_back(e);
    s.enabled = false;
  });
  std::shuffle(subjects.begin(), subjects.end(), std::mt19937(9));
  for (const Entity e : subjects) {
    one_by_one.world.get<CloseupSubject>(e).enabled = true;
    one_by_one.run();
  }
  together.run();
  EXPECT_EQ(together.pairs(), one_by_one.pairs());
  expect_same(together.views(), one_by_one.views(), false);
}

TEST(CloseupSystems, the_most_important_pairs_are_kept_and_the_rest_are_counted) {
  CloseupWorld w;
  fill(w, 5);
  w.closeup_settings().max_pairs = 1000;
  const CloseupViews all = w.run();
  ASSERT_GT(all.pairs.size(), 10u);
  EXPECT_EQ(all.in_view, all.pairs.size() + all.skipped);
  for (std::size_t i = 0; i + 1 < all.pairs.size(); ++i) {
    const CloseupView &a = all.pairs[i], &b = all.pairs[i + 1];
    EXPECT_TRUE(a.priority > b.priority || (a.priority == b.priority && a.coverage >= b.coverage));
  }
  for (const std::uint32_t most : {0u, 1u, 7u}) {
    w.closeup_settings().max_pairs = most;
    const CloseupViews& some = w.run();
    ASSERT_EQ(some.pairs.size(), most);
    EXPECT_EQ(some.in_view, all.in_view);
    EXPECT_EQ(some.skipped, all.in_view - most);
    for (std::size_t i = 0; i < most; ++i) EXPECT_EQ(some.pairs[i].pair, all.pairs[i].pair);
  }
  w.closeup_settings().enabled = false;
  EXPECT_TRUE(w.run().pairs.empty());
  EXPECT_EQ(w.views().in_view, 0u);
}

TEST(CloseupSystems, a_pair_that_no_map_can_hold_takes_no_ones_place) {
  CloseupWorld w;
  const Entity around = w.add_subject(dmat4(1.0), 5.0f);
  const Entity beside = w.add_subject(at(3, 0, 0), 1.0f);
  const Entity light = w.add_light(at(0.1, 0, 0));
  w.closeup_settings().max_pairs = 1;
  const CloseupViews& views = w.run();
  EXPECT_EQ(w.pairs(), 2u);
  ASSERT_EQ(views.pairs.size(), 1u);
  EXPECT_EQ(views.pairs[0].subject, beside);
  EXPECT_EQ(views.pairs[0].light, light);
  EXPECT_EQ(views.in_view, 2u) << "that of " << around.index << " too";
  EXPECT_EQ(views.skipped, 1u);
}

TEST(CloseupSystems, a_pair_says_which_light_of_the_view_it_is_and_what_its_map_shows) {
  CloseupWorld w;
  const Entity subject = w.add_subject();
  const Entity sun = w.add_light(glm::rotate(dmat4(1.0), -1.0, dvec3(1, 0, 0)), LightKind::directional);
  const Entity lamp = w.add_light(at(0, 3, 0));
  w.world.create(MeshInstance{}, WorldTransform{at(0, -7.5, 0)});
  const CloseupViews& views = w.run();
  ASSERT_EQ(views.pairs.size(), 2u);
  const auto& visible = w.world.view_resource<VisibleLights>(w.settings.id);
  for (const CloseupView& pair : views.pairs) {
    EXPECT_EQ(w.pair(subject, pair.light), pair.pair);
    EXPECT_EQ(pair.directional, pair.light == sun);
    const auto lights = pair.directional ? directional_lights(visible) : local_lights(visible);
    EXPECT_EQ(lights[pair.light_index], pair.light);
    EXPECT_EQ(pair.face.light, pair.light);
    EXPECT_EQ(pair.face.kind, pair.directional ? LightKind::directional : LightKind::spot);
    EXPECT_NEAR(pair.coverage, static_cast<double>(pair.tiles.tiles()) / (80.0 * 45.0), 1e-6);
    if (pair.directional) {
      EXPECT_NEAR(pair.penumbra_m_per_m, 2.0 * std::tan(0.5 * 0.00925025), 1e-6);
      EXPECT_GT(pair.face.far_m, 6.0f) << "to what the shadow falls on";
    } else {
      EXPECT_EQ(pair.light, lamp);
      EXPECT_EQ(pair.light_position, dvec3(0, 3, 0));
      EXPECT_FLOAT_EQ(pair.emitter_diameter_m, 0.1f);
      EXPECT_NEAR(pair.face.near_m, 2.5, 1e-4);
    }
  }
  w.settings.world_from_camera = at(0, 0, -40);
  EXPECT_EQ(w.run().in_view, 0u) << "behind the camera";
}

}  // namespace
}  // namespace gloam
