// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/rooms.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "tests/modules/reflections/culling/proxy_oracle.h"

namespace gloam {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices chosen_by(const test::ProxyScene& scene, const dvec3& camera) {
  Indices chosen;
  choose_rooms(scene.placed().rooms, camera, chosen);
  return chosen;
}

/// Proxies with a band for this camera.
Indices reflected_by(const test::ProxyScene& scene, const dvec3& camera) {
  const ProxySet set = scene.placed();
  const Indices chosen = chosen_by(scene, camera);
  Indices reflected;
  for (std::uint32_t i = 0; i < set.proxies.size(); ++i)
    if (receiver_bands(set.proxies[i], set.rooms, chosen, camera).count > 0) reflected.push_back(i);
  return reflected;
}

/// Rooms: 0 from x = 0 to 10, 1 from 8 to 18 (overlaps), 2 nested in 0 around x = 2. Proxies at x = 1, 5, 9, 15, 30.
test::ProxyScene three_rooms() {
  test::ProxyScene scene;
  scene.add_room({5.0, 2.0, 0.0}, {10.0f, 4.0f, 10.0f});
  scene.add_room({13.0, 3.0, 0.0}, {10.0f, 4.0f, 10.0f});
  scene.add_room({2.0, 2.0, 0.0}, {3.0f, 2.0f, 3.0f});
  for (const double x : {1.0, 5.0, 9.0, 15.0, 30.0}) scene.add({x, 2.0, 0.0}, {0.0, 0.0, 1.0}, {1.0f, 1.0f});
  return scene;
}

// Hard case: reflections.rooms_overlap, reflections.rooms_nested
TEST(IbrRooms, that_contain_the_camera_are_all_chosen) {
  const test::ProxyScene scene = three_rooms();
  EXPECT_EQ(chosen_by(scene, {5.0, 2.0, 0.0}), (Indices{0}));
  EXPECT_EQ(chosen_by(scene, {2.0, 2.0, 0.0}), (Indices{0, 2}));
  EXPECT_EQ(chosen_by(scene, {9.0, 2.0, 0.0}), (Indices{0, 1}));
  EXPECT_EQ(chosen_by(scene, {15.0, 2.0, 0.0}), (Indices{1}));
  EXPECT_EQ(chosen_by(scene, {15.0, 0.5, 0.0}), (Indices{}));
}

TEST(IbrRooms, the_smallest_that_contains_the_camera_decides_on_tiers) {
  test::ProxyScene scene = three_rooms();
  scene.rooms[0].world_from_node = glm::scale(scene.rooms[0].world_from_node, dvec3(0.9));  // smaller than room 1
  const std::vector<PlacedRoom> rooms = scene.placed().rooms;
  const auto smallest_at = [&](double x) { return smallest_room(rooms, chosen_by(scene, {x, 2.0, 0.0})); };
  EXPECT_EQ(smallest_at(5.0), &rooms[0]);
  EXPECT_EQ(smallest_at(2.0), &rooms[2]);
  EXPECT_EQ(smallest_at(9.0), &rooms[0]);
  EXPECT_EQ(smallest_at(15.0), &rooms[1]);
  EXPECT_EQ(smallest_at(30.0), nullptr);
  EXPECT_NEAR(rooms[2].volume_m3, 18.0, 1e-9);
}

// Hard case: reflections.camera_on_room_face
TEST(IbrRooms, contain_a_camera_on_their_faces_edges_and_corners) {
  for (const double offset : {0.0, 1e4, 3e6}) {
    for (const double turn : {0.0, 0.3, 2.0}) {
      test::ProxyScene scene;
      dmat4 pose = glm::translate(dmat4(1.0), dvec3(offset, 0.1 * offset, -offset));
      pose = glm::scale(glm::rotate(pose, turn, dvec3(0.3, 1.0, 0.1)), dvec3(0.7, 1.9, 1.3));
      scene.add_room(dvec3(0.0), {10.0f, 4.0f, 6.0f}).world_from_node = pose;
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const dvec3 on(5.0 * x, 2.0 * y, 3.0 * z);
            EXPECT_EQ(chosen_by(scene, dvec3(pose * dvec4(on, 1.0))), (Indices{0})) << x << y << z;
            if (x == 0 && y == 0 && z == 0) continue;
            EXPECT_EQ(chosen_by(scene, dvec3(pose * dvec4(on * 1.0001, 1.0))), Indices{}) << x << y << z;
          }
    }
  }
}

// Hard case: reflections.rooms_overlap, reflections.rooms_nested
TEST(IbrRooms, let_only_their_own_proxies_be_reflected) {
  const test::ProxyScene scene = three_rooms();
  EXPECT_EQ(reflected_by(scene, {5.0, 2.0, 0.0}), (Indices{0, 1, 2}));
  EXPECT_EQ(reflected_by(scene, {2.0, 2.0, 0.0}), (Indices{0, 1, 2})) << "the nested room adds none";
  EXPECT_EQ(reflected_by(scene, {9.0, 2.0, 0.0}), (Indices{0, 1, 2, 3}));
  EXPECT_EQ(reflected_by(scene, {15.0, 2.0, 0.0}), (Indices{2, 3})) << "proxy 2 is in both rooms";
  EXPECT_EQ(reflected_by(scene, {50.0, 2.0, 0.0}), (Indices{4})) << "outside all rooms";
}

TEST(IbrRooms, that_are_absent_let_all_proxies_be_reflected) {
  test::ProxyScene scene = three_rooms();
  scene.rooms.clear();
  EXPECT_EQ(reflected_by(scene, {5.0, 2.0, 0.0}), (Indices{0, 1, 2, 3, 4}));
}

TEST(ReceiverBands, begin_at_the_lowest_floor_of_the_shared_rooms) {
  const ProxySet set = three_rooms().placed();
  const auto lowest = [&](std::size_t proxy, const dvec3& camera) {
    Indices chosen;
    choose_rooms(set.rooms, camera, chosen);
    const ReceiverBands bands = receiver_bands(set.proxies[proxy], set.rooms, chosen, camera);
    EXPECT_EQ(bands.count, 1u);
    EXPECT_TRUE(std::isinf(bands.bands[0].highest_m));
    return bands.bands[0].lowest_m;
  };
  EXPECT_NEAR(lowest(2, {9.0, 2.0, 0.0}), 0.0 - kReceiverSlack, 1e-12) << "rooms 0 and 1 share it";
  EXPECT_NEAR(lowest(3, {9.0, 2.0, 0.0}), 1.0 - kReceiverSlack, 1e-12) << "only room 1";
  EXPECT_NEAR(lowest(0, {2.0, 2.0, 0.0}), 0.0 - kReceiverSlack, 1e-12) << "the outer room reaches lower";
  EXPECT_NEAR(lowest(4, {50.0, -7.0, 0.0}), -7.0 - kOpenExtension, 1e-12) << "the eye is lower than the proxy";
  EXPECT_NEAR(lowest(4, {50.0, 9.0, 0.0}), 1.5 - kOpenExtension, 1e-12);
}

// Hard case: reflections.two_floors
TEST(ReceiverBands, lie_around_the_stated_heights_and_merge) {
  test::ProxyScene scene;
  scene.add({0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, {1.0f, 1.0f});
  const auto bands_of = [&] {
    const ProxySet set = scene.placed();
    Indices chosen;
    choose_rooms(set.rooms, {1.0, 3.0, 0.0}, chosen);
    return receiver_bands(set.proxies[0], set.rooms, chosen, {1.0, 3.0, 0.0});
  };
  scene.add_room({0.0, 3.0, 0.0}, vec3(6.0f)).heights = ReflectingHeights{{0.0f, 2.5f, 2.51f}, 3};
  ReceiverBands bands = bands_of();
  ASSERT_EQ(bands.count, 2u);
  EXPECT_NEAR(bands.bands[0].lowest_m, -kReceiverSlack, 1e-6);
  EXPECT_NEAR(bands.bands[0].highest_m, kReceiverSlack, 1e-6);
  EXPECT_NEAR(bands.bands[1].lowest_m, 2.5 - kReceiverSlack, 1e-6);
  EXPECT_NEAR(bands.bands[1].highest_m, 2.51 + kReceiverSlack, 1e-6);

  scene.add_room({0.0, 3.0, 0.0}, vec3(4.0f));  // floor at 1 m, every height above it
  bands = bands_of();
  ASSERT_EQ(bands.count, 2u);
  EXPECT_NEAR(bands.bands[1].lowest_m, 1.0 - kReceiverSlack, 1e-6);
  EXPECT_TRUE(std::isinf(bands.bands[1].highest_m));
}

TEST(ReceiverBands, cover_all_heights_when_there_are_more_than_fit) {
  test::ProxyScene scene;
  scene.add({0.0, 3.0, 0.0}, {0.0, 0.0, 1.0}, {1.0f, 1.0f});
  for (int room = 0; room < 3; ++room) {
    const auto base = static_cast<float>(room);
    scene.add_room({0.0, 3.0, 0.0}, vec3(6.0f)).heights =
        ReflectingHeights{{base, base + 0.25f, base + 0.5f, base + 0.75f}, 4};
  }
  const ProxySet set = scene.placed();
  Indices chosen;
  choose_rooms(set.rooms, {1.0, 3.0, 0.0}, chosen);
  const ReceiverBands bands = receiver_bands(set.proxies[0], set.rooms, chosen, {1.0, 3.0, 0.0});
  ASSERT_LE(bands.count, ReceiverBands::kCapacity);
  for (double height = 0.0; height < 2.9; height += 0.25)
    EXPECT_TRUE(std::ranges::any_of(bands.all(), [&](const ReceiverBand& b) {
      return b.lowest_m <= height && height <= b.highest_m;
    })) << height;
}

}  // namespace
}  // namespace gloam
