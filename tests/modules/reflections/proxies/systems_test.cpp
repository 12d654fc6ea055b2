// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/systems.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "engine/core/hash.h"
#include "modules/reflections/module.h"
#include "tests/jobs/executors.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"
#include "tests/support/module_world.h"

namespace gloam {
namespace {

/// A world with proxies in two archetypes, a room and one view.
struct ProxyRoom : test::ModuleWorld {
  std::vector<Entity> proxies;
  Entity room = kNoEntity;

  explicit ProxyRoom(int count) : ModuleWorld(make_reflections_module()) {
    settings.world_from_camera = glm::translate(dmat4(1.0), dvec3(0.0, 1.7, 0.0));
    IbrRoom box;
    box.size_m = vec3(30.0f, 6.0f, 30.0f);
    room = world.create(box, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 3.0, 0.0))});
    test::ProxyRandom random(4);
    for (int i = 0; i < count; ++i) {
      IbrProxy proxy;
      proxy.size_m = vec2(2.0f, 1.5f);
      const dvec3 center(random.between(-12.0, 12.0), random.between(0.5, 4.0), random.between(-14.0, 2.0));
      const WorldTransform transform{
          glm::rotate(glm::translate(dmat4(1.0), center), random.between(-3.0, 3.0), dvec3(0.0, 1.0, 0.0))};
      proxies.push_back(i % 3 == 0 ? world.create(proxy, transform, Parent{}) : world.create(proxy, transform));
    }
  }
  [[nodiscard]] const ProxySet& set() const { return world.resource<ProxySet>(); }
  [[nodiscard]] const ProxyTiles& tiles() const { return world.view_resource<ProxyTiles>(settings.id); }
  [[nodiscard]] std::uint64_t hash() const {
    Hasher hasher;
    for (const std::uint32_t proxy : tiles().proxies) hasher.value(set().proxies[proxy].entity.index);
    for (const std::uint32_t word : tiles().masks) hasher.value(word);
    return hasher.digest();
  }
};

TEST(ProxySystems, have_their_names_and_module) {
  ProxyRoom room(1);
  const std::string text = room.schedule.describe();
  for (const char* name : {"ibr_proxies", "proxy_tiles"}) EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(ProxySystems, gather_proxies_in_the_order_of_entities) {
  ProxyRoom room(40);
  room.run();
  ASSERT_EQ(room.set().proxies.size(), 40u);
  for (std::size_t i = 1; i < 40; ++i)
    EXPECT_LT(room.set().proxies[i - 1].entity.index, room.set().proxies[i].entity.index);
  EXPECT_EQ(room.set().rooms.size(), 1u);
  EXPECT_EQ(room.tiles().outcomes.size(), 40u);
  EXPECT_GT(room.tiles().proxies.size(), 3u);
}

// Hard case: reflections.no_area
TEST(ProxySystems, count_and_leave_out_proxies_and_rooms_that_cannot_be_placed) {
  ProxyRoom room(6);
  room.world.get<WorldTransform>(room.proxies[1]).matrix[3].x = std::numeric_limits<double>::quiet_NaN();
  room.world.get<IbrProxy>(room.proxies[3]).size_m.x = 0.0f;
  room.world.get<WorldTransform>(room.room).matrix[1] *= 0.0;
  room.run();
  EXPECT_EQ(room.set().proxies.size(), 4u);
  EXPECT_EQ(room.set().not_finite, 1u);
  EXPECT_EQ(room.set().no_area, 1u);
  EXPECT_EQ(room.set().rooms.size(), 0u);
  EXPECT_EQ(room.set().unusable_rooms, 1u);
  const std::uint64_t version = room.set().version;
  room.run();
  EXPECT_EQ(room.set().version, version) << "NaN is no change";
}

TEST(ProxySystems, build_tiles_only_after_a_change) {
  ProxyRoom room(40);
  room.run();
  std::uint64_t version = room.tiles().version;
  std::uint64_t hash = room.hash();
  room.run();
  EXPECT_EQ(room.tiles().version, version);
  const auto expect_change = [&](const char* what, bool different = true) {
    room.run();
    EXPECT_NE(room.tiles().version, version) << what;
    EXPECT_TRUE(!different || room.hash() != hash) << what;
    version = room.tiles().version;
    hash = room.hash();
  };
  room.world.get<WorldTransform>(room.proxies[5]).matrix[3].y += 0.1;
  expect_change("proxy moved", false);
  room.settings.world_from_camera = glm::rotate(room.settings.world_from_camera, 0.5, dvec3(0.0, 1.0, 0.0));
  expect_change("camera turned");
  room.settings.width = 641;
  expect_change("size", false);
  room.settings.camera.orthographic = true;
  expect_change("projection");
  room.settings.camera.orthographic = false;
  expect_change("projection back");
  ASSERT_TRUE(room.knobs.set("ibr.tiles", "64").ok());
  expect_change("tiles");
  room.world.get<WorldTransform>(room.room).matrix[3].x = 40.0;
  expect_change("room moved", false);
  room.world.add(room.room, ReflectingHeights{{0.0f}, 1});
  expect_change("heights", false);
  room.world.destroy(room.proxies[0]);
  expect_change("proxy destroyed", false);
}

TEST(ProxySystems, make_the_same_tiles_with_every_executor) {
  ProxyRoom expected(512);
  expected.run();
  for (const test::ExecutorCase& c : test::all_executors()) {
    ProxyRoom room(512);
    room.run(*c.make());
    EXPECT_EQ(room.hash(), expected.hash()) << c.name;
  }
}

TEST(ProxySystems, are_not_demanded_without_proxies_and_probes) {
  ProxyRoom room(0);
  EXPECT_FALSE(room.module->demand(room.world, nullptr).needed);
  room.run();
  EXPECT_TRUE(room.tiles().masks.empty());
}

}  // namespace
}  // namespace gloam
