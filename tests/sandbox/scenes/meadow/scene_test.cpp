// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/meadow/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"
#include "modules/grass/components.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"
#include "sandbox/session/loading/scene_loading.h"

namespace gloam {
namespace {

constexpr double kEdge = 12.0;
constexpr double kStep_s = 0.1;
constexpr int kSteps = 600;

struct Triangle {
  dvec3 a, b, c;
};

dvec3 nearest_on_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
  return glm::mix(a, b, glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0));
}

double distance_to(const Triangle& t, const dvec3& p) {
  const dvec3 normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
  const dvec3 q = p - normal * glm::dot(p - t.a, normal);
  const auto is_left = [&](const dvec3& a, const dvec3& b) {
    return glm::dot(glm::cross(b - a, q - a), normal) >= 0.0;
  };
  if (is_left(t.a, t.b) && is_left(t.b, t.c) && is_left(t.c, t.a)) return glm::length(p - q);
  return std::min({glm::length(p - nearest_on_segment(p, t.a, t.b)), glm::length(p - nearest_on_segment(p, t.b, t.c)),
                   glm::length(p - nearest_on_segment(p, t.c, t.a))});
}

/// The triangles of field, path and hills within 18 m of the middle, by squares of 1 m that their boxes touch.
class Ground {
 public:
  void add(const Primitive& shape) {
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
      std::array<dvec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = dvec3(shape.positions[shape.indices[i + k]]);
      const dvec3 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
      if (low.x < -kReach || low.z < -kReach || high.x >= kReach || high.z >= kReach) continue;
      for (int x = square(low.x); x <= square(high.x); ++x)
        for (int z = square(low.z); z <= square(high.z); ++z) at(x, z).push_back({p[0], p[1], p[2]});
    }
  }

  /// Height of the ground; NaN where there is none.
  [[nodiscard]] double height(double x, double z) const {
    for (const Triangle& t : squares_[index(square(x), square(z))]) {
      const double whole = cross(t.b - t.a, t.c - t.a);
      const double u = cross(dvec3(x, 0.0, z) - t.a, t.c - t.a) / whole;
      const double v = cross(t.b - t.a, dvec3(x, 0.0, z) - t.a) / whole;
      if (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9) return t.a.y + u * (t.b.y - t.a.y) + v * (t.c.y - t.a.y);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  /// Distance of a point from the triangles within 1 m around it.
  [[nodiscard]] double distance(const dvec3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int x = square(p.x) - 1; x <= square(p.x) + 1; ++x)
      for (int z = square(p.z) - 1; z <= square(p.z) + 1; ++z)
        for (const Triangle& t : squares_[index(x, z)]) nearest = std::min(nearest, distance_to(t, p));
    return nearest;
  }

 private:
  static constexpr double kReach = 18.0;
  static constexpr int kSide = 36;

  static double cross(const dvec3& a, const dvec3& b) { return a.x * b.z - a.z * b.x; }
  static int square(double x) { return static_cast<int>(std::floor(x + kReach)); }
  static std::size_t index(int x, int z) { return static_cast<std::size_t>(z * kSide + x); }
  std::vector<Triangle>& at(int x, int z) { return squares_[index(x, z)]; }

  std::vector<std::vector<Triangle>> squares_ = std::vector<std::vector<Triangle>>(kSide * kSide);
};

struct Meadow {
  ModuleList modules = make_all_modules();
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  World world;
  SceneInfo info;
  Schedule schedule;
  Ground ground;

  explicit Meadow(void (*build)(World&, SceneInfo&) = &build_meadow_scene) {
    prepare_world(world, modules);
    build(world, info);
    add_scene_systems(schedule);
    for (const char* part : {"field", "path", "hills"}) ground.add(shape(part));
    pose(0.0);
  }

  void pose(double time_s) {
    world.resource<SceneClock>().time_s = time_s;
    schedule.run(Stage::world, world, *executor);
  }
  [[nodiscard]] Entity node(const char* kind, const std::string& name) const {
    const auto found = world.resource<SceneNames>().find(kind, name);
    EXPECT_TRUE(found.ok()) << name;
    return found.ok() ? *found : kNoEntity;
  }
  [[nodiscard]] const Primitive& shape(const char* name) const {
    return world.resource<SceneAssets>().meshes[world.get<MeshInstance>(node("mesh", name)).mesh].primitives[0];
  }
  [[nodiscard]] const dmat4& matrix(Entity entity) const { return world.get<WorldTransform>(entity).matrix; }
  [[nodiscard]] dvec3 place(Entity entity) const { return dvec3(matrix(entity)[3]); }
  [[nodiscard]] std::string name(Entity entity) const {
    return std::string(world.resource<SceneNames>().name_of(entity));
  }
  [[nodiscard]] std::vector<Entity> colliders(ColliderShape of_shape) {
    std::vector<Entity> found;
    world.view<const Collider>().each([&](Entity entity, const Collider& collider) {
      if (collider.shape == of_shape) found.push_back(entity);
    });
    return found;
  }
};

double horizontal_distance(const dvec3& a, const dvec3& b) { return std::hypot(a.x - b.x, a.z - b.z); }

bool is_in_field(const dvec3& p, double margin) {
  return std::abs(p.x) <= kEdge - margin && std::abs(p.z) <= kEdge - margin;
}

TEST(MeadowScene, has_40_entities_and_6_lights_that_cast_shadows) {
  Meadow meadow;
  std::size_t entities = 0;
  meadow.world.view<const WorldTransform>().each([&](const WorldTransform& transform) {
    ++entities;
    for (int i = 0; i < 16; ++i) EXPECT_TRUE(std::isfinite(transform.matrix[i / 4][i % 4]));
  });
  EXPECT_EQ(entities, 40u);
  EXPECT_EQ(meadow.info.cameras.size(), 6u);
  std::map<LightKind, int> kinds;
  meadow.world.view<const Light, Maybe<const ShadowCaster>>().each([&](const Light& light, const ShadowCaster* caster) {
    ++kinds[light.kind];
    EXPECT_TRUE(caster == nullptr || caster->enabled);
  });
  EXPECT_EQ(kinds, (std::map<LightKind, int>{{LightKind::spot, kMeadowLanterns}, {LightKind::directional, 1}}));
}

TEST(MeadowScene, by_day_has_one_sun_and_the_same_things) {
  Meadow night, day(&build_meadow_day_scene);
  EXPECT_EQ(day.world.view<const Light>().size(), 1u);
  EXPECT_EQ(day.world.view<const MeshInstance>().size(), night.world.view<const MeshInstance>().size());
  EXPECT_EQ(day.world.view<const Collider>().size(), night.world.view<const Collider>().size());
  EXPECT_EQ(day.world.resource<SceneAssets>().clips.size(), night.world.resource<SceneAssets>().clips.size());
}

TEST(MeadowScene, grows_100000_blades_beside_a_bare_path) {
  Meadow meadow;
  double blades = 0.0;
  meadow.world.view<const GrassSurface, const MeshInstance>().each(
      [&](Entity entity, const GrassSurface& surface, const MeshInstance&) {
        EXPECT_EQ(meadow.name(entity), "field");
        EXPECT_EQ(surface.height_m, vec2(0.3f, 0.06f));
        EXPECT_EQ(surface.width_m, 0.006f);
        EXPECT_EQ(surface.max_distance_m, 40.0f);
        const Primitive& shape = meadow.shape("field");
        for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
          const vec3& a = shape.positions[shape.indices[i]];
          const dvec3 normal(
              glm::cross(shape.positions[shape.indices[i + 1]] - a, shape.positions[shape.indices[i + 2]] - a));
          EXPECT_GT(normal.y, 0.0);
          blades += 0.5 * glm::length(normal) * double{surface.density};
        }
      });
  EXPECT_NEAR(blades, kMeadowBlades, 0.01 * kMeadowBlades);
  ASSERT_EQ(meadow.world.view<const Wind>().size(), 1u);
  const Wind& wind = meadow.world.get<Wind>(meadow.node("node", "wind"));
  EXPECT_GT(glm::length(wind.velocity), 1.0f);
  EXPECT_EQ(wind.gust, 0.4f);
}

TEST(MeadowScene, the_ground_has_no_gaps) {
  Meadow meadow;
  for (double x = -15.0; x < 15.0; x += 0.0873)
    for (double z = -15.0; z < 15.0; z += 0.0911)
      ASSERT_TRUE(std::isfinite(meadow.ground.height(x, z))) << x << " " << z;
}

TEST(MeadowScene, balls_and_the_walker_move_and_crates_rest) {
  Meadow meadow;
  const AnimatedNodes animated(meadow.world);
  EXPECT_EQ(meadow.colliders(ColliderShape::sphere).size(), static_cast<std::size_t>(kMeadowBalls));
  EXPECT_EQ(meadow.colliders(ColliderShape::capsule).size(), 1u);
  EXPECT_EQ(meadow.colliders(ColliderShape::box).size(), 2u);
  for (const Entity ball : meadow.colliders(ColliderShape::sphere)) EXPECT_TRUE(animated.has_channel(ball));
  for (const Entity walker : meadow.colliders(ColliderShape::capsule)) {
    EXPECT_TRUE(animated.has_channel(walker));
    EXPECT_EQ(meadow.world.get<Collider>(walker).height_m, 1.8f);
  }
  for (const char* part : {"body", "head", "left leg", "right leg", "left arm", "right arm"})
    EXPECT_TRUE(animated.moves(meadow.node("mesh", part))) << part;
  for (const Entity crate : meadow.colliders(ColliderShape::box)) {
    EXPECT_FALSE(animated.moves(crate));
    const dvec3 place = meadow.place(crate);
    const double half = 0.5 * double{meadow.world.get<Collider>(crate).size_m.y};
    EXPECT_NEAR(place.y - half, meadow.ground.height(place.x, place.z), 0.1);
    const Aabb& box = meadow.shape(meadow.name(crate).c_str()).bounds;
    EXPECT_NEAR(double{box.max.y}, half, 1e-6) << "the node's origin is the middle of the box";
    EXPECT_NEAR(double{box.min.y}, -half, 1e-6);
  }
}

TEST(MeadowScene, balls_touch_the_ground_and_stay_in_the_field) {
  Meadow meadow;
  const std::vector<Entity> balls = meadow.colliders(ColliderShape::sphere);
  for (int step = 0; step < 2 * kSteps; ++step) {
    meadow.pose(0.5 * kStep_s * step);
    for (const Entity ball : balls) {
      const double radius = double{meadow.world.get<Collider>(ball).radius_m};
      const dvec3 place = meadow.place(ball);
      ASSERT_TRUE(is_in_field(place, radius)) << meadow.name(ball);
      ASSERT_NEAR(meadow.ground.distance(place), radius, 0.02) << meadow.name(ball) << " at step " << step;
      ASSERT_GT(place.y, meadow.ground.height(place.x, place.z));
    }
  }
}

TEST(MeadowScene, balls_roll_without_slipping) {
  Meadow meadow;
  const std::vector<Entity> balls = meadow.colliders(ColliderShape::sphere);
  constexpr double kShort_s = 0.02;
  for (int step = 0; step < kSteps; step += 3) {
    for (const Entity ball : balls) {
      const double radius = double{meadow.world.get<Collider>(ball).radius_m};
      meadow.pose(kStep_s * step);
      const dmat4 before = meadow.matrix(ball);
      meadow.pose(kStep_s * step + kShort_s);
      const dmat4 after = meadow.matrix(ball);
      const dvec3 centre(before[3]);
      const double low = meadow.ground.height(centre.x, centre.z);
      const dvec3 slope_x(
          0.2, meadow.ground.height(centre.x + 0.1, centre.z) - meadow.ground.height(centre.x - 0.1, centre.z), 0.0);
      const dvec3 slope_z(
          0.0, meadow.ground.height(centre.x, centre.z + 0.1) - meadow.ground.height(centre.x, centre.z - 0.1), 0.2);
      const dvec3 contact = centre - radius * glm::normalize(glm::cross(slope_z, slope_x));
      ASSERT_NEAR(contact.y, low, 0.1);
      const dvec4 on_ball = glm::inverse(before) * dvec4(contact, 1.0);
      const double slip = glm::length(dvec3(after * on_ball) - contact);
      const double way = glm::length(dvec3(after[3]) - centre);
      ASSERT_GT(way, 0.5 * kShort_s) << meadow.name(ball);
      ASSERT_LT(slip, 0.1 * way) << meadow.name(ball) << " at step " << step;
    }
  }
}

TEST(MeadowScene, the_walker_stays_on_the_ground_of_the_field_and_faces_ahead) {
  Meadow meadow;
  const Entity walker = meadow.node("node", "walker");
  for (int step = 0; step < kSteps; ++step) {
    meadow.pose(kStep_s * step);
    const dmat4 before = meadow.matrix(walker);
    const dvec3 place(before[3]);
    ASSERT_TRUE(is_in_field(place, 0.5));
    ASSERT_NEAR(place.y, meadow.ground.height(place.x, place.z), 0.02);
    ASSERT_NEAR(before[1].y, 1.0, 1e-6) << "upright";
    meadow.pose(kStep_s * (step + 1));
    dvec3 way = meadow.place(walker) - place;
    ASSERT_NEAR(glm::length(way) / kStep_s, 1.2, 0.15);
    way.y = 0.0;
    ASSERT_GT(glm::dot(glm::normalize(way), dvec3(before[2])), 0.98);
  }
}

TEST(MeadowScene, cameras_are_above_the_ground_and_one_walks) {
  Meadow meadow;
  const AnimatedNodes animated(meadow.world);
  const Entity walk = meadow.node("camera", "walk");
  EXPECT_EQ(meadow.info.cameras.front(), meadow.node("camera", "near"));
  for (const Entity camera : meadow.info.cameras) EXPECT_EQ(animated.moves(camera), camera == walk);
  for (int step = 0; step < kSteps; ++step) {
    meadow.pose(kStep_s * step);
    const dvec3 before = meadow.place(walk);
    for (const Entity camera : meadow.info.cameras) {
      const dvec3 eye = meadow.place(camera);
      ASSERT_GT(eye.y - meadow.ground.height(eye.x, eye.z), 0.3) << meadow.name(camera);
    }
    ASSERT_TRUE(is_in_field(before, 1.0));
    ASSERT_NEAR(before.y - meadow.ground.height(before.x, before.z), 1.65, 0.02);
    meadow.pose(kStep_s * (step + 1));
    ASSERT_NEAR(glm::length(meadow.place(walk) - before) / kStep_s, 1.4, 0.07);
  }
}

TEST(MeadowScene, nothing_that_moves_meets_anything_in_a_round) {
  struct Thing {
    Entity entity;
    double radius_m;
  };
  Meadow meadow;
  std::vector<Thing> moving = {{meadow.node("camera", "walk"), 0.3}, {meadow.node("node", "walker"), 0.3}};
  for (const Entity ball : meadow.colliders(ColliderShape::sphere))
    moving.push_back({ball, double{meadow.world.get<Collider>(ball).radius_m}});
  std::vector<Thing> all = moving;
  for (const Entity crate : meadow.colliders(ColliderShape::box))
    all.push_back({crate, 0.7072 * double{meadow.world.get<Collider>(crate).size_m.x}});
  for (int i = 1; i <= kMeadowLanterns; ++i) all.push_back({meadow.node("mesh", "pole " + std::to_string(i)), 0.06});
  for (const char* camera : {"near", "far", "ground", "lanterns"}) all.push_back({meadow.node("camera", camera), 0.3});
  for (int step = 0; step < kSteps; ++step) {
    meadow.pose(kStep_s * step);
    for (std::size_t i = 0; i < moving.size(); ++i) {
      for (std::size_t k = i + 1; k < all.size(); ++k) {
        const double gap = horizontal_distance(meadow.place(moving[i].entity), meadow.place(all[k].entity)) -
                           moving[i].radius_m - all[k].radius_m;
        ASSERT_GT(gap, 0.2) << meadow.name(moving[i].entity) << ", " << meadow.name(all[k].entity) << " at step "
                            << step;
      }
    }
  }
}

TEST(MeadowScene, repeats_after_a_minute) {
  Meadow meadow;
  std::vector<dmat4> first;
  for (const double time_s : {7.3, 7.3 + kMeadowRound_s}) {
    meadow.pose(time_s);
    std::size_t i = 0;
    meadow.world.view<const WorldTransform>().each([&](const WorldTransform& transform) {
      if (time_s < kMeadowRound_s) return first.push_back(transform.matrix);
      const dmat4& before = first[i++];
      for (int k = 0; k < 4; ++k) EXPECT_LT(glm::length(before[k] - transform.matrix[k]), 1e-4);
    });
  }
}

TEST(MeadowScene, no_module_warns) {
  for (const auto build : {&build_meadow_scene, &build_meadow_day_scene}) {
    Meadow meadow(build);
    for (const auto& module : meadow.modules) EXPECT_TRUE(module->warnings(meadow.world).empty()) << module->name();
  }
}

}  // namespace
}  // namespace gloam
