// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/lights/lists/light_scenes.h"
#include "tests/support/scale.h"

/// Light lists over several frames: knobs, list capacity, several views and worlds, moving cameras.
namespace gloam {
namespace {

using test::LightScene;
using test::point_lamp;
using test::spot_lamp;

struct LightFramesTest : test::LightScenesTest {
  /// More list entries than the initial capacity holds.
  LightScene crowded() {
    LightScene s = stage();
    for (int i = 0; i < 1024; ++i) s.light(point_lamp(0.01f, 30.0f), dvec3(0.01 * i - 5.0, 2.0, 0.0));
    s.view.width = 161;
    s.view.height = 97;
    return s;
  }
};

TEST_F(LightFramesTest, with_any_bound_and_any_number_of_bins_are_the_same) {
  LightScene s = stage();
  scatter(s, 150, 23, 1.3);
  s.view.width = 130;
  for (const char* bound : {"rect", "row_interval", "cone"}) {
    set("lights.tile_bound", bound);
    expect_tiled_is_brute(s, bound);
  }
  for (const char* bins : {"256", "512", "1024", "2048", "4096"}) {
    set("lights.z_bins", bins);
    expect_tiled_is_brute(s, bins);
  }
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, with_fixed_slots_are_the_same_and_tiles_with_more_lights_are_counted) {
  LightScene s = stage();
  scatter(s, 150, 29, 1.8);
  double most = 1e30;
  for (const char* slots : {"1", "3", "4", "30", "1024"}) {
    set("lights.fixed_slots", slots);
    const Drawn frame = expect_tiled_is_brute(s, std::string("fixed slots ") + slots);
    if (HasFatalFailure()) return;
    const double overflow = counter(frame, "lights.overflow_tiles");
    EXPECT_LE(overflow, most) << slots;
    most = overflow;
    if (std::string(slots) == "1") {
      EXPECT_GT(overflow, 0.0);
    }
  }
  EXPECT_EQ(most, 0.0) << "1024 entries a tile are enough for any list";
  set("lights.fixed_slots", "0");
  expect_tiled_is_brute(s, "flexible again");
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, whose_lists_do_not_fit_are_the_same_and_soon_fit) {
  LightScene s = crowded();
  const Drawn brute = drawn(*s.world, s.view, "brute");
  if (HasFatalFailure()) return;
  Drawn frame;
  for (int i = 0; i < 6; ++i) {
    frame = drawn(*s.world, s.view, "tiled");
    if (HasFatalFailure()) return;
    expect_same(frame, brute, "frame " + std::to_string(i));
    expect_sound(frame, "frame " + std::to_string(i));
  }
  EXPECT_EQ(counter(frame, "lights.overflow_tiles"), 0.0);
  EXPECT_GE(counter(frame, "lights.list_capacity"), counter(frame, "lights.list_entries"));
  EXPECT_GT(counter(frame, "lights.list_entries"), 200000.0);
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, without_a_wait_between_them_are_the_same) {
  LightScene s = crowded();
  set("lights.culling", "tiled");
  const ViewRequest request{s.view, {}};
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(renderer->render(*s.world, std::span(&request, 1)).ok());
  ASSERT_TRUE(renderer->wait().ok());
  Drawn tiled;
  tiled.light = linear();
  tiled.picture = picture();
  expect_same(tiled, drawn(*s.world, s.view, "brute"), "the sixth");
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, of_two_views_are_the_same_as_of_each_alone) {
  LightScene s = stage();
  scatter(s, 120, 31, 1.5);
  ViewSettings other = test::look_at(dvec3(-4.0, 2.5, -1.0), dvec3(0.0, 0.5, -1.0), 33, 71);
  other.id = ViewId{1};
  set("lights.culling", "tiled");
  const ViewRequest both[] = {{s.view, {}}, {other, {}}};
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(renderer->render(*s.world, both).ok());
    ASSERT_TRUE(renderer->wait().ok());
  }
  Drawn first, second;
  first.light = linear(0);
  first.picture = picture(0);
  second.light = linear(1);
  second.picture = picture(1);
  second.counters = renderer->report().counters;
  expect_sound(second, "second view");
  expect_same(first, drawn(*s.world, s.view, "brute"), "first view");
  expect_same(second, drawn(*s.world, other, "brute"), "second view");
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, of_two_worlds_in_turn_are_the_same_as_of_each_alone) {
  LightScene small = stage();
  small.light(point_lamp(3.0f, 4.0f), dvec3(0.3, 1.2, 0.0));
  LightScene large = crowded();
  large.view.width = 193;
  LightScene dark = stage();
  Drawn expected[3];
  LightScene* scenes[] = {&small, &large, &dark};
  for (int i = 0; i < 3; ++i) expected[i] = drawn(*scenes[i]->world, scenes[i]->view, "brute");
  for (int frame = 0; frame < 9; ++frame) {
    const int i = frame % 3;
    const Drawn tiled = drawn(*scenes[i]->world, scenes[i]->view, "tiled");
    if (HasFatalFailure()) return;
    expect_sound(tiled, "world " + std::to_string(i));
    expect_same(tiled, expected[i], "world " + std::to_string(i) + ", frame " + std::to_string(frame));
  }
  for (LightScene* s : scenes) renderer->release_world(*s->world);
}

/// A camera that flies, cuts, and changes size and lens, among lights that move, appear and disappear.
TEST_F(LightFramesTest, of_a_moving_camera_among_moving_lights_are_the_same) {
  LightScene s = stage();
  scatter(s, 120, 37, 1.3);
  const Entity moved = s.light(spot_lamp(20.0f, 6.0f, 0.5f), dvec3(0.0, 2.0, 0.0));
  const Entity dimmed = s.light(point_lamp(1.0f, 3.0f), dvec3(1.0, 1.0, 1.0));
  const auto set_frame = [&](int frame) {
    const double t = frame / 20.0;
    const dvec3 eye =
        frame < 12 ? dvec3(3.0 * std::sin(6.0 * t), 1.2 + t, 5.0 - 6.0 * t) : dvec3(-4.0, 2.5, -3.0 + 4.0 * t);
    s.look(eye, eye + dvec3(-0.5 * std::cos(3.0 * t), -0.3, -1.0 + (frame >= 12 ? 1.5 : 0.0)), frame < 16 ? 97u : 129u,
           frame < 16 ? 65u : 41u);
    s.view.camera.orthographic = frame == 18;
    s.view.camera.half_height_m = 3.0f;
    s.world->get<WorldTransform>(moved).matrix =
        LightScene::node_towards(dvec3(2.0 * std::sin(9.0 * t), 1.5, -3.0 * t), dvec3(t - 0.5, -1.0, 0.2));
    s.world->mark_changed<WorldTransform>(moved);
    s.world->get<Light>(dimmed).intensity = frame % 3 == 0 ? 0.0f : static_cast<float>(1 + frame);
    s.world->mark_changed<Light>(dimmed);
  };
  std::vector<Drawn> tiled;
  for (int frame = 0; frame < 20; ++frame) {
    set_frame(frame);
    tiled.push_back(drawn(*s.world, s.view, "tiled"));
    if (HasFatalFailure()) return;
    expect_sound(tiled.back(), "frame " + std::to_string(frame));
  }
  for (int frame = 0; frame < 20; ++frame) {
    set_frame(frame);
    expect_same(tiled[static_cast<std::size_t>(frame)], drawn(*s.world, s.view, "brute"),
                "frame " + std::to_string(frame));
    if (HasFatalFailure()) return;
  }
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, after_lights_are_destroyed_and_made_are_the_same) {
  LightScene s = stage();
  std::vector<Entity> lights;
  std::mt19937 random(41);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int step = 0; step < 6; ++step) {
    for (int i = 0; i < (step == 3 ? 0 : 40); ++i)
      lights.push_back(s.light(point_lamp(1.0f, 1.5f), dvec3(4.0 * unit(random), 1.0, 4.0 * unit(random))));
    while (lights.size() > (step == 3 ? 0u : 25u)) {
      std::swap(lights[random() % lights.size()], lights.back());
      s.world->destroy(lights.back());
      lights.pop_back();
    }
    expect_tiled_is_brute(s, "step " + std::to_string(step));
    if (HasFatalFailure()) return;
  }
  renderer->release_world(*s.world);
}

TEST_F(LightFramesTest, of_random_scenes_are_the_same) {
  const int count = test::scaled(120);
  for (int seed = 0; seed < count; ++seed) {
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    LightScene s =
        stage(1e4 * std::floor(2.0 * std::abs(unit(random))) * dvec3(unit(random), unit(random), unit(random)));
    const std::uint32_t cube = s.make.mesh(test::box(vec3(0.2f)));
    for (int i = 0; i < 12; ++i)
      s.draw(cube,
             glm::rotate(glm::translate(dmat4(1.0), dvec3(3.0 * unit(random), 1.0 + unit(random), 3.0 * unit(random))),
                         3.0 * unit(random), glm::normalize(dvec3(unit(random), 1.0, unit(random)))));
    const int lights = static_cast<int>(std::pow(10.0, 1.25 + 1.25 * unit(random)));
    scatter(s, lights, static_cast<std::uint32_t>(seed + 1000), std::pow(10.0, 0.7 * unit(random)));
    const dvec3 eye(4.0 * unit(random), 1.6 + 1.4 * unit(random), 4.0 * unit(random));
    s.view.camera = {.orthographic = seed % 5 == 4,
                     .fov_y = static_cast<float>(1.2 + unit(random)),
                     .half_width_m = 3.0f,
                     .half_height_m = 2.5f,
                     .near_m = static_cast<float>(0.1 * std::pow(10.0, unit(random)))};
    s.look(eye, dvec3(unit(random), 0.7 + 0.3 * unit(random), unit(random)),
           static_cast<std::uint32_t>(16 + random() % 120), static_cast<std::uint32_t>(16 + random() % 90));
    s.view.world_from_camera = s.view.world_from_camera * glm::rotate(dmat4(1.0), unit(random), dvec3(0.0, 0.0, 1.0));
    expect_tiled_is_brute_and_release(std::move(s), "seed " + std::to_string(seed));
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace gloam
