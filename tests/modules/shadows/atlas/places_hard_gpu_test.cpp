// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

/// Lights, cameras, receivers and casters in difficult positions.
class ShadowPlaces : public test::HardShadows {};

// Hard case: shadows.cone_0, shadows.cone_180
TEST_F(ShadowPlaces, cones_of_0_119_121_and_180_degrees_cast_right_shadows) {
  yard();
  const Entity bulb = lamp(spot(30.0, 0.05f), dvec3(0.2, 2.0, 0.3), dvec3(0.1, -1.0, -0.1));
  for (const double degrees : {119.0, 121.0, 180.0}) {
    Light& made = world.get<Light>(bulb);
    made.outer_angle = static_cast<float>(glm::radians(0.5 * degrees));
    made.inner_angle = 0.9f * made.outer_angle;
    expect_right("cone of " + std::to_string(static_cast<int>(degrees)), bulb, 2000);
    expect_finite("cone");
  }
  for (const float angle : {0.0f, 1e-6f, -1.0f}) {
    world.get<Light>(bulb).outer_angle = world.get<Light>(bulb).inner_angle = angle;
    draw();
    expect_finite("no cone");
  }
}

// Hard case: shadows.camera_inside_light, shadows.light_behind_camera
TEST_F(ShadowPlaces, a_light_within_the_cameras_near_plane_and_a_camera_within_a_light) {
  yard();
  const dvec3 eye(settings.world_from_camera[3]), ahead = -dvec3(settings.world_from_camera[2]);
  const Entity bulb = lamp(point(0.02f), eye + 0.05 * ahead);
  expect_right("before the near plane", bulb);
  place(bulb, glm::translate(dmat4(1.0), eye));
  expect_right("at the camera", bulb);
  place(bulb, glm::translate(dmat4(1.0), eye - 0.2 * ahead + dvec3(0.3, 0.4, 0.0)));
  expect_right("behind the camera", bulb);
  place(bulb, at(0.3, 0.35, 0.9));
  settings = test::look_at(dvec3(0.3, 0.36, 0.91), dvec3(-0.3, 0.2, 0.0), 96, 54);
  expect_right("a centimetre from the light", bulb);
  expect_finite("a centimetre from the light");
}

// Hard case: shadows.receiver_before_near_plane
TEST_F(ShadowPlaces, what_is_nearer_to_a_light_than_its_near_plane_is_lit) {
  floor();
  settings = test::look_at(dvec3(0.0, 0.12, 0.1), dvec3(0.0), 96, 54);
  settings.camera.near_m = 0.005f;
  for (const double height : {0.04, 0.01, 0.0, -0.01})
    for (const bool wide : {false, true}) {
      const std::vector<Entity> lamps = {
          lamp(point(wide ? 0.02f : 0.0f), dvec3(0.0, height, 0.0)),
          lamp(spot(40.0, wide ? 0.02f : 0.0f), dvec3(0.0, height, 0.0), dvec3(0.0, -1.0, 0.0))};
      draw();
      expect_finite("a light on the floor");
      for (const Entity lamp : lamps) {
        const std::vector<float> seen = visibility(lamp);
        std::size_t dark = 0, bad = 0, checked = 0;
        for (std::uint32_t y = 0; y < settings.height; ++y)
          for (std::uint32_t x = 0; x < settings.width; ++x) {
            const Ray r = ray(x, y);
            if (r.direction.y >= 0.0) continue;
            const dvec3 point = r.origin - r.direction * (r.origin.y / r.direction.y);
            const float v = seen[y * settings.width + x];
            bad += std::isfinite(v) && v <= 1.0f ? 0 : 1;
            // Check points that the light certainly reaches from above: not those where only rounding of its height
            // decides.
            if (height < 1e-3 || glm::distance(point, dvec3(0.0, height, 0.0)) > 0.049 || v < 0.0f) continue;
            dark += v < 0.99f ? 1 : 0;
            ++checked;
          }
        EXPECT_EQ(dark, 0u) << height << " " << name_of(lamp) << (wide ? " wide" : "");
        EXPECT_GE(checked, height < 1e-3 ? 0u : 20u) << height << " " << name_of(lamp);
        EXPECT_EQ(bad, 0u) << height << " " << name_of(lamp);
        world.get<ShadowCaster>(lamp).enabled = false;
        world.get<Light>(lamp).intensity = 0.0f;
      }
    }
}

// Hard case: shadows.lamp_in_housing
TEST_F(ShadowPlaces, a_lamp_inside_its_housing_lights_only_what_its_open_side_looks_at) {
  floor();
  thing(test::quad(3.0f, stone), at(0.0, 0.0, -1.6));
  const double half = 0.06, height = 0.7;
  box(dvec3(0.0, height + half, 0.0), dvec3(half, 0.002, half));
  for (const double side : {-1.0, 1.0}) {
    box(dvec3(side * half, height, 0.0), dvec3(0.002, half, half));
    box(dvec3(0.0, height, side * half), dvec3(half, half, 0.002));
  }
  const Entity bulb = lamp(point(), dvec3(0.0, height, 0.0));
  settings = test::look_at(dvec3(0.5, 1.6, 2.2), dvec3(0.0, 0.2, -0.3), 96, 54);
  const TracedVisibility traced = trace(1);
  const ShadowError e = error(bulb, traced);
  expect_right("housing", e, 3000);
  EXPECT_EQ(e.leaks, 0u);
  std::size_t lit = 0, dark = 0;
  for (const std::uint8_t v : traced.layer(0)) (v == 255 ? lit : dark) += v == 255 || v == 0 ? 1 : 0;
  EXPECT_GT(lit, 200u);
  EXPECT_GT(dark, 1000u);
}

TEST_F(ShadowPlaces, casters_behind_the_camera_cast_shadows_before_it) {
  floor();
  box(dvec3(0.0, 1.0, 3.0), dvec3(0.4, 0.4, 0.1));
  settings = test::look_at(dvec3(0.0, 1.0, 2.0), dvec3(0.0, 0.0, -0.5), 96, 54);
  const std::vector<Entity> lamps = {lamp(point(), dvec3(0.1, 1.6, 4.4)),
                                     lamp(spot(30.0), dvec3(-0.1, 1.6, 4.4), dvec3(0.1, -0.4, -1.0)),
                                     lamp(sun(), dvec3(0.0), dvec3(0.05, -0.45, -1.0))};
  const TracedVisibility traced = trace(1);
  for (const Entity lamp : lamps) {
    expect_right("caster behind the camera", error(lamp, traced));
    std::size_t dark = 0;
    for (const std::uint8_t v : traced.layer(*traced.layer_of(lamp))) dark += v == 0 ? 1 : 0;
    EXPECT_GT(dark, 200u) << name_of(lamp);
  }
}

// Hard case: shadows.node_zero_scale, shadows.node_mirrored, shadows.node_sheared, shadows.degenerate_triangles
TEST_F(ShadowPlaces, mirrored_sheared_and_flattened_casters_and_degenerate_triangles) {
  floor();
  const dmat4 up = at(0.0, 0.5, 0.0);
  Primitive wedge = test::box(vec3(0.2f), stone);
  for (vec3& position : wedge.positions)
    if (position.y > 0.0f) position.x *= 0.3f;
  const std::uint32_t mesh = scene.mesh(test::finished(wedge));
  dmat4 sheared(1.0);
  sheared[1] = dvec4(0.6, 1.0, 0.3, 0.0);
  const auto put = [&](const dmat4& matrix) { things.push_back(scene.draw(mesh, matrix)); };
  put(at(-1.2, 0.4, 0.0) * glm::scale(dmat4(1.0), dvec3(-1.0, 1.0, 1.0)));
  put(at(-0.5, 0.4, 0.3) * sheared);
  put(at(0.2, 0.4, 0.1) * sheared * glm::scale(dmat4(1.0), dvec3(1.0, 1.0, -1.0)));
  put(at(0.8, 0.4, 0.0) * glm::scale(dmat4(1.0), dvec3(1.0, 0.0, 1.0)));
  put(at(1.3, 0.4, 0.4) * glm::scale(dmat4(1.0), dvec3(0.0)));
  put(at(-0.2, 0.4, -0.6) * glm::scale(dmat4(1.0), dvec3(0.0, 1.0, 1.0)));
  Primitive degenerate = test::quad(0.3f, stone);
  degenerate.indices = {0, 1, 2, 0, 0, 0, 1, 1, 3, 0, 2, 3, 2, 3, 2};
  thing(test::finished(degenerate), at(0.6, 0.5, -0.8));
  Primitive needle = test::quad(0.3f, stone);
  for (vec3& position : needle.positions) position.y = 0.0f;
  thing(test::finished(needle), up);
  const std::vector<Entity> lamps = {lamp(point(), dvec3(-0.4, 2.2, 1.0)),
                                     lamp(sun(), dvec3(0.0), dvec3(0.4, -1.0, -0.3), 2048)};
  const TracedVisibility traced = trace(1);
  for (const Entity lamp : lamps) expect_right("odd casters", error(lamp, traced));
  expect_finite("odd casters");
}

// Surfaces in one plane: rasterised, their depths are equal but for rounding.
// Hard case: shadows.receiver_is_blocker
TEST_F(ShadowPlaces, plates_in_the_plane_of_the_floor_cast_nothing_onto_it) {
  floor();
  Material leaf = exact_material(170, 180, 160, 255, 0);
  leaf.double_sided = true;
  const std::uint32_t sheet = scene.material(leaf);
  thing(test::quad(0.7f, sheet), glm::rotate(at(0.4, 0.0, 0.2), 0.5, dvec3(0.0, 1.0, 0.0)) * flat(0.0));
  thing(test::quad(0.6f, stone), glm::rotate(at(-0.7, 0.0, 0.1), 0.3, dvec3(0.0, 1.0, 0.0)) * flat(0.0));
  box(dvec3(0.0, -0.2, -0.8), dvec3(0.4, 0.2, 0.3), 0.4);  // let into the floor: its top is in its plane
  const std::vector<Entity> lamps = {lamp(point(0.1f), dvec3(-1.3, 1.9, 1.1)),
                                     lamp(spot(35.0, 0.1f), dvec3(1.9, 2.1, -0.7), dvec3(-1.9, -1.9, 0.7)),
                                     lamp(sun(0.05f), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 2048)};
  for (const char* filter : {"hard", "pcf", "pcss", "chs"}) {
    set("shadows.filter", filter);
    for (const Entity lamp : lamps) {
      std::size_t reached = 0, dark = 0;
      for (const float seen : visibility(lamp)) {
        reached += seen < 0.0f ? 0 : 1;
        dark += seen < 0.0f || seen >= 0.999f ? 0 : 1;
      }
      EXPECT_GT(reached, 500u) << filter << ", " << name_of(lamp);
      EXPECT_EQ(dark, 0u) << filter << ", " << name_of(lamp) << ": of " << reached;
    }
  }
}

// Hard case: shadows.at_100_km
TEST_F(ShadowPlaces, a_scene_at_100_km_from_the_origin_has_the_shadows_it_has_there) {
  yard();
  const std::vector<Entity> lamps = {lamp(point(0.1f), dvec3(-1.3, 1.9, 1.1)),
                                     lamp(spot(35.0, 0.1f), dvec3(1.9, 2.1, -0.7), dvec3(-1.9, -1.9, 0.7)),
                                     lamp(sun(0.05f), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 2048)};
  std::vector<std::vector<float>> here;
  for (const Entity lamp : lamps) here.push_back(visibility(lamp));
  const dvec4 away(100000.0, -30000.0, 100000.0, 0.0);
  for (const Entity entity : things) world.get<WorldTransform>(entity).matrix[3] += away;
  settings.world_from_camera[3] += away;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const std::vector<float> there = visibility(lamps[i]);
    ASSERT_EQ(there.size(), here[i].size());
    double sum = 0.0;
    std::size_t far_off = 0;
    for (std::size_t p = 0; p < there.size(); ++p) {
      const double off = std::abs(static_cast<double>(there[p]) - static_cast<double>(here[i][p]));
      sum += off;
      far_off += off > 0.1 ? 1 : 0;
    }
    std::printf("%s at 100 km: mean %.5f, %zu of %zu off by more than 0.1\n", name_of(lamps[i]).c_str(),
                sum / static_cast<double>(there.size()), far_off, there.size());
    // There, cascades have another texel grid.
    const bool cascades = i == 2;
    EXPECT_LE(sum, (cascades ? 0.005 : 0.0005) * static_cast<double>(there.size()));
    EXPECT_LE(static_cast<double>(far_off), (cascades ? 0.01 : 0.001) * static_cast<double>(there.size()));
  }
  const TracedVisibility traced = trace();
  for (const Entity lamp : lamps) expect_right("at 100 km", error(lamp, traced));
}

}  // namespace
}  // namespace gloam
