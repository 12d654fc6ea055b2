// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/debug/unseen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "engine/scene/resources.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"
#include "modules/reflections/module.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kQuarter = 1.57079632679489661923;

struct CapturedScene {
  CapturedScene() {
    prepare_scene_world(world);
    module->register_components(world);
  }
  std::uint32_t material(float reflectivity, float roughness, bool double_sided = false) {
    Material made;
    made.reflectivity = reflectivity;
    made.roughness = roughness;
    made.double_sided = double_sided;
    return maker.material(std::move(made));
  }
  /// A square of 2 · half metres' side that faces up, turned about X by `turn` more.
  Entity floor(double half, const dvec3& place, std::uint32_t made_of, double turn = 0.0) {
    const dmat4 pose = glm::rotate(glm::translate(dmat4(1.0), place), turn - kQuarter, dvec3(1.0, 0.0, 0.0));
    return maker.draw(maker.mesh(test::quad(static_cast<float>(half), made_of)), pose);
  }
  template <class C>
  Entity add(const std::string& name, C component, const dmat4& pose) {
    const Entity entity = world.create(component, WorldTransform{pose});
    world.resource<SceneNames>().add("node", name, entity);
    return entity;
  }
  /// Faces +Z turned about Y and then about X.
  void proxy(const std::string& name, const dvec3& place, double about_y = 0.0, double about_x = 0.0,
             const vec2& size = vec2(2.0f)) {
    IbrProxy quad;
    quad.size_m = size;
    const dmat4 turned = glm::rotate(glm::translate(dmat4(1.0), place), about_y, dvec3(0.0, 1.0, 0.0));
    add(name, quad, glm::rotate(turned, about_x, dvec3(1.0, 0.0, 0.0)));
  }
  void probe(const std::string& name, const dvec3& place, bool global = false) {
    CubeProbe box;
    box.size_m = global ? vec3(0.0f) : vec3(4.0f);
    box.global = global;
    add(name, box, glm::translate(dmat4(1.0), place));
  }
  void room(const std::string& name, const dvec3& center, const vec3& size, IbrRoomTiers tiers = IbrRoomTiers::all) {
    add(name, IbrRoom{.size_m = size, .tiers = tiers}, glm::translate(dmat4(1.0), center));
  }
  [[nodiscard]] std::vector<std::string> told() const { return unseen_captures(world); }

  World world;
  test::SceneMaker maker{world};
  std::unique_ptr<Module> module = make_reflections_module();
};

struct UnseenCaptures : testing::Test, CapturedScene {};

TEST_F(UnseenCaptures, are_all_where_nothing_reflects) {
  floor(5.0, {}, material(0.0f, 0.0f));
  proxy("wall", {0.0, 1.0, -2.0});
  probe("hall", {});
  probe("all", {}, true);
  EXPECT_THAT(told(),
              ElementsAre("no surface shows 1 reflection proxy: wall, because the scene has no smooth material",
                          "no surface shows 2 probes: hall, all, because the scene has no reflective material"));
}

TEST_F(UnseenCaptures, are_the_proxies_over_a_rough_floor) {
  floor(5.0, {}, material(1.0f, 1.0f));
  proxy("east", {0.0, 1.0, -2.0});
  proxy("west", {1.0, 1.0, -2.0});
  probe("hall", {});
  EXPECT_THAT(
      told(),
      ElementsAre("no surface shows 2 reflection proxies: east, west, because the scene has no smooth material"));
}

// Hard case: reflections.nothing_shows
TEST_F(UnseenCaptures, are_proxies_behind_or_below_every_mirror) {
  floor(2.0, {}, material(1.0f, 0.0f));
  proxy("before", {0.0, 1.0, -3.0});
  proxy("beside", {-3.0, 1.0, 0.0}, kQuarter);
  proxy("ceiling", {0.0, 3.0, 0.0}, 0.0, kQuarter);  // faces down
  proxy("across", {0.0, 0.5, 0.0});                  // a half of the floor is in front of it
  proxy("away", {0.0, 1.0, -3.0}, 2.0 * kQuarter);
  proxy("below", {0.0, -2.0, -3.0});
  proxy("faces down below", {0.0, -2.0, 0.0}, 0.0, kQuarter);
  proxy("faces up", {0.0, 1.0, 0.0}, 0.0, -kQuarter);
  EXPECT_THAT(told(), ElementsAre("no surface shows 4 reflection proxies: away, below, faces down below, faces up, "
                                  "because it faces away from or lies below every smooth surface that faces up"));
}

TEST_F(UnseenCaptures, are_proxies_that_only_steep_or_downward_mirrors_could_show) {
  const std::uint32_t mirror = material(1.0f, 0.0f), both = material(1.0f, 0.0f, true);
  floor(2.0, {}, mirror, 1.0);                         // steeper than 30°
  floor(2.0, {0.0, -1.0, 0.0}, mirror, 2 * kQuarter);  // faces down
  proxy("wall", {0.0, 1.0, -3.0});
  EXPECT_THAT(told(), ElementsAre(HasSubstr("wall, because no smooth surface faces up")));
  floor(2.0, {0.0, -1.0, 0.0}, both, 2 * kQuarter);  // its other side faces up
  EXPECT_THAT(told(), IsEmpty());
}

TEST_F(UnseenCaptures, are_proxies_whose_rooms_have_no_mirror_at_their_heights) {
  floor(2.0, {}, material(1.0f, 0.0f));
  room("cellar", {0.0, -3.0, 0.0}, {20.0f, 4.0f, 20.0f});  // up to y = −1
  room("attic", {0.0, 5.0, 0.0}, {20.0f, 4.0f, 20.0f});    // from y = 3 on
  proxy("in the cellar", {0.0, -2.0, -3.0}, 0.0, 0.0, {2.0f, 8.0f});
  proxy("in the attic", {0.0, 4.0, -3.0});
  proxy("outside", {0.0, 2.0, -3.0});
  EXPECT_THAT(told(), ElementsAre("no surface shows 2 reflection proxies: in the cellar, in the attic, because no "
                                  "smooth surface lies at a height that its rooms serve"));
}

TEST_F(UnseenCaptures, are_proxies_of_rooms_without_that_tier) {
  floor(2.0, {}, material(1.0f, 0.0f));
  room("hall", {0.0, 2.0, 0.0}, {8.0f, 4.0f, 8.0f}, IbrRoomTiers::ssr_cube);
  proxy("wall", {0.0, 1.0, -3.0});
  EXPECT_THAT(told(), ElementsAre(HasSubstr("wall, because gloam.ibr_room.tiers of its rooms leaves proxies out")));
  room("corner", {0.0, 2.0, 0.0}, {2.0f, 4.0f, 2.0f}, IbrRoomTiers::ibr_cube);
  EXPECT_THAT(told(), IsEmpty()) << "a camera in the corner sees the proxy";
}

TEST_F(UnseenCaptures, are_probes_whose_box_no_reflective_surface_reaches) {
  floor(2.0, {}, material(1.0f, 1.0f));
  probe("near", {3.5, 0.0, 0.0});
  probe("far", {4.5, 0.0, 0.0});
  probe("all", {100.0, 0.0, 0.0}, true);
  EXPECT_THAT(told(), ElementsAre("no surface shows 1 probe: far, because no reflective surface reaches into its box"));
}

TEST_F(UnseenCaptures, of_no_size_are_named_and_so_are_rooms) {
  floor(2.0, {}, material(1.0f, 0.0f));
  proxy("point", {0.0, 1.0, -3.0}, 0.0, 0.0, vec2(0.0f));
  room("flat", {}, {1.0f, 0.0f, 1.0f});
  EXPECT_THAT(told(),
              ElementsAre("no surface shows 1 reflection proxy: point, because a side of it is zero or not finite",
                          HasSubstr("no effect have 1 IBR room: flat, because")));
}

TEST_F(UnseenCaptures, are_counted_beyond_24_names) {
  for (int i = 0; i < 30; ++i) proxy("p" + std::to_string(i), {0.0, 1.0, -2.0});
  ASSERT_EQ(told().size(), 1u);
  EXPECT_THAT(told()[0], HasSubstr("no surface shows 30 reflection proxies: p0, p1"));
  EXPECT_THAT(told()[0], HasSubstr("p23 and 6 more, because"));
}

/// Whether some ray of many meets the proxy by the rules of the culling, for a camera anywhere on the mirrored ray.
bool some_ray_meets(const PlacedProxy& proxy, const std::vector<PlacedRoom>& rooms, const dmat4& floor, double half,
                    test::ProxyRandom& random) {
  std::vector<std::uint32_t> chosen;
  for (int i = 0; i < 400; ++i) {
    const dvec3 from(floor * dvec4(random.between(-half, half), random.between(-half, half), 0.0, 1.0));
    const dvec3 to = proxy.center + random.between(-1.0, 1.0) * proxy.half_u + random.between(-1.0, 1.0) * proxy.half_v;
    const dvec3 ray = to - from;
    if (!(ray.y > 1e-3 * glm::length(ray)) || !(glm::dot(ray, proxy.normal) < 0.0)) continue;
    const dvec3 eye = from + random.between(0.05, 3.0) * dvec3(-ray.x, ray.y, -ray.z);
    choose_rooms(rooms, eye, chosen);
    const ReceiverBands bands = receiver_bands(proxy, rooms, chosen, eye);
    if (std::ranges::any_of(
            bands.all(), [&](const ReceiverBand& band) { return band.lowest_m <= from.y && from.y <= band.highest_m; }))
      return true;
  }
  return false;
}

// Hard case: reflections.nothing_shows
TEST_F(UnseenCaptures, are_never_among_those_that_some_ray_meets) {
  test::ProxyRandom random(7);
  std::size_t unseen = 0, met = 0;
  for (int trial = 0; trial < 400; ++trial) {
    CapturedScene scene;
    const double half = random.between(0.2, 3.0);
    const dvec3 place(random.between(-3.0, 3.0), random.between(-2.0, 2.0), random.between(-3.0, 3.0));
    const Entity drawn = scene.floor(half, place, scene.material(1.0f, 0.0f), random.between(-0.5, 0.5));
    scene.proxy("proxy", {random.between(-4.0, 4.0), random.between(-2.5, 2.5), random.between(-4.0, 4.0)},
                random.between(-3.0, 3.0), random.between(-1.6, 1.6), vec2(1.5f, 0.8f));
    std::vector<PlacedRoom> rooms;
    for (int i = trial % 3; i > 0; --i) {
      const dvec3 center(random.between(-2.0, 2.0), random.between(-2.0, 2.0), random.between(-2.0, 2.0));
      const vec3 size(static_cast<float>(random.between(2.0, 8.0)), static_cast<float>(random.between(1.0, 4.0)), 6.0f);
      scene.room("room", center, size);
      ASSERT_TRUE(place_room({}, {.size_m = size}, nullptr, glm::translate(dmat4(1.0), center), rooms.emplace_back()));
    }
    PlacedProxy placed;
    scene.world.view<const IbrProxy, const WorldTransform>().each(
        [&](Entity entity, const IbrProxy& proxy, const WorldTransform& transform) {
          ASSERT_EQ(place_proxy(entity, proxy, transform.matrix, placed), ProxyPlacement::placed);
        });
    const bool shown = some_ray_meets(placed, rooms, scene.world.get<WorldTransform>(drawn).matrix, half, random);
    const bool named = !scene.told().empty();
    ASSERT_FALSE(shown && named) << trial << ": " << scene.told()[0];
    unseen += named ? 1 : 0;
    met += shown ? 1 : 0;
  }
  EXPECT_GT(unseen, 60u);
  EXPECT_GT(met, 100u);
}

}  // namespace
}  // namespace gloam
