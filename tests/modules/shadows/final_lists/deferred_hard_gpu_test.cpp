// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/components.h"
#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// Difficult lights, cameras and positions: deferred gives the same picture as monolithic, without NaN or infinity.

namespace gloam {
namespace {

using test::Dice;
using test::ReadFinalLists;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class DeferredShadowsHard : public test::DeferredShadowsTest {
 protected:
  void put_yard() {
    put_room();
    put(shapes_[0], glm::scale(glm::rotate(at(-0.5, 0.3, 0.2), 0.4, dvec3(0.0, 1.0, 0.0)), dvec3(0.3, 0.6, 0.3)));
    put(shapes_[1], glm::scale(at(0.5, 0.5, -0.4), dvec3(0.5)));
    put(shapes_[4], glm::scale(glm::rotate(at(0.1, 0.25, 0.7), 0.8, dvec3(0.0, 1.0, 0.0)), dvec3(0.3, 0.5, 0.2)));
    put(shapes_[3], glm::rotate(at(1.0, 0.6, 0.3), 1.0, dvec3(0.3, 1.0, 0.0)));
    put(shapes_[3], glm::scale(at(-1.1, 0.003, 0.8) * flat(0.0), dvec3(0.4)));
  }
  Entity put_lamp(const dvec3& position) { return put_light(point(0.08f), position, dvec3(0.0, -1.0, 0.0), 64); }
  /// Compares both modes, and checks that all float images are finite.
  ReadFinalLists expect_sound(const std::string& what) {
    const Drawn drawn = expect_deferred_is_monolithic(what);
    for (const float channel : drawn.light.rgba) {
      const bool sound = std::isfinite(channel) && channel >= 0.0f && channel <= 65504.0f;
      EXPECT_TRUE(sound) << what << ": " << channel;
      if (!sound) break;
    }
    for (const auto& [name, value] : renderer->report().counters)
      EXPECT_TRUE(std::isfinite(value)) << what << ": " << name;
    const ReadFinalLists found = lists();
    if (found.counters.pairs > 0) expect_finite_maps(what);
    return found;
  }
  /// Checks all mips of all faces. Texels between faces are undefined.
  void expect_finite_maps(const std::string& what) {
    const auto images =
        renderer->read_images(world, settings.id, std::vector<std::string_view>{"shadow_atlas", "shadow_pyramid"});
    ASSERT_TRUE(images.ok()) << images.error().message;
    std::size_t bad = 0, looked = 0;
    for (std::size_t which = 0; which < 2; ++which) {
      const ImageBytes& image = (*images)[which];
      const std::uint32_t halves = which == 0 ? 1 : 2, size = image.height / halves;
      const std::uint32_t first = which == 0 ? 0 : GLOAM_SHADOW_PYRAMID_MIP;
      std::vector<float> values(image.bytes.size() / sizeof(float));
      std::memcpy(values.data(), image.bytes.data(), image.bytes.size());
      for (const ShadowFace& face : world.view_resource<ViewFaces>(settings.id).faces)
        for (std::uint32_t mip = first; face.square.size >> mip != 0; ++mip) {
          const std::uint32_t level = mip - first, side = face.square.size >> mip;
          const uvec2 corner = mip_corner(size, level) + (face.square.origin >> mip);
          for (std::uint32_t i = 0; i < side * side; ++i)
            for (std::uint32_t half = 0; half < halves; ++half) {
              const std::size_t row = std::size_t{half * size + corner.y + i / side};
              bad += std::isfinite(values[row * image.width + corner.x + i % side]) ? 0 : 1;
              ++looked;
            }
        }
    }
    EXPECT_EQ(bad, 0u) << what << ": shadow maps";
    EXPECT_GT(looked, 0u) << what;
  }
};

// Hard case: shadows.camera_inside_light, shadows.light_at_near_plane, further.camera_inside_emitter
TEST_F(DeferredShadowsHard, a_camera_inside_a_light_and_lights_about_the_near_plane) {
  put_yard();
  settings = test::look_at(dvec3(0.3, 1.0, 2.0), dvec3(0.0, 0.3, 0.0), 64, 48);
  const dvec3 eye(settings.world_from_camera[3]), ahead = -dvec3(settings.world_from_camera[2]);
  const Entity bulb = put_lamp(eye);
  world.get<Light>(bulb).width_m = 0.3f;
  for (const double metres : {0.0, 0.05, 0.0999, 0.1, 0.15, -0.05, -1.0}) {
    place(bulb, glm::translate(dmat4(1.0), eye + metres * ahead));
    EXPECT_GT(expect_sound("lamp " + std::to_string(metres) + " m ahead").counters.candidates, 0u);
  }
  // Its range ends near the camera's near plane.
  world.get<Light>(bulb).range_m = 0.2f;
  for (const double metres : {-0.15, -0.05, 0.0}) {
    place(bulb, glm::translate(dmat4(1.0), eye + metres * ahead));
    expect_sound("short lamp " + std::to_string(metres) + " m ahead");
  }
}

// Hard case: shadows.position_not_finite, shadows.intensity_not_finite, shadows.range_not_finite
// Hard case: shadows.negative_intensity, shadows.all_finite
TEST_F(DeferredShadowsHard, lights_without_sense_beside_one_that_has) {
  put_yard();
  put_lamp(dvec3(0.4, 1.4, 0.9));
  expect_sound("one");
  int number = 0;
  const auto add = [&](auto&& change) {
    Light made = number % 2 == 0 ? point(0.05f) : spot(40.0, 0.05f);
    change(made);
    put_light(made, dvec3(0.1 * number, 1.2, 0.6), dvec3(0.0, -1.0, 0.1), 32);
    ++number;
    return lamps.back();
  };
  for (const float value : {kNan, kInfinity, -kInfinity, -3.0f, 0.0f})
    for (int i = 0; i < 2; ++i) add([&](Light& l) { l.intensity = value; });
  expect_sound("intensities");
  for (const float value : {kNan, kInfinity, -1.0f, 1e-30f})
    for (int i = 0; i < 2; ++i) add([&](Light& l) { l.range_m = value, l.intensity = 0.1f; });
  for (const float value : {kNan, kInfinity, -1.0f, 1e9f})
    for (int i = 0; i < 2; ++i) add([&](Light& l) { l.width_m = value, l.intensity = 0.1f; });
  for (const float value : {kNan, 0.0f, -1.0f, 3.2f})
    for (int i = 0; i < 2; ++i) add([&](Light& l) { l.outer_angle = l.inner_angle = value, l.intensity = 0.1f; });
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
    for (int i = 0; i < 2; ++i)
      place(add([&](Light& l) { l.intensity = 0.1f; }), glm::translate(dmat4(1.0), dvec3(0.0, value, 0.0)));
  expect_sound("everything");
  Light broken = sun(kNan);
  broken.intensity = kInfinity;
  put_light(broken, dvec3(0.0), dvec3(0.1, -1.0, 0.1), 64);
  expect_sound("and a sun");
}

// Hard case: shadows.million_candela
TEST_F(DeferredShadowsHard, a_million_candela_at_a_centimetre) {
  put_yard();
  put_lamp(dvec3(0.0, 0.01, 0.9));
  world.get<Light>(lamps[0]).intensity = 1e6f;
  put_lamp(dvec3(-0.3, 0.3, 0.36));
  world.get<Light>(lamps[1]).intensity = 1e6f;
  expect_sound("bright");
}

// Hard case: shadows.lights_1023, shadows.lights_1024, shadows.lights_1025
TEST_F(DeferredShadowsHard, a_thousand_lights_in_one_tile) {
  put(plane_, flat(0.0) * glm::scale(dmat4(1.0), dvec3(3.0)));
  put(shapes_[0], glm::scale(at(0.1, 0.5, 0.0), dvec3(0.3, 0.05, 0.3)));
  settings = test::look_at(dvec3(0.4, 1.2, 1.4), dvec3(0.1, 0.0, 0.0), 8, 8);
  Light made = spot(50.0, 0.05f);
  made.intensity = 0.02f;
  for (int i = 0; i < 1100; ++i) {
    const bool casts = i % 8 == 0;
    if (i == 1023 || i == 1024 || i == 1025) {
      const ReadFinalLists found = expect_sound(std::to_string(i) + " lights");
      EXPECT_EQ(found.counters.candidates, std::min(i, 1024));
      EXPECT_EQ(found.texels.size(), 1u);
    }
    put_light(made, dvec3(0.1 + 0.0005 * (i % 32), 1.0 + 0.001 * (i / 32), 0.1), dvec3(0.0, -1.0, 0.01), 16, casts);
  }
  const ReadFinalLists found = expect_sound("1100 lights");
  EXPECT_EQ(found.counters.candidates, 1024u) << "no more reach a frame";
  EXPECT_GT(found.counters.unshadowed, 800u);
}

// Hard case: shadows.all_sky, shadows.sky_and_near
TEST_F(DeferredShadowsHard, nothing_but_sky_and_sky_beside_near_things) {
  put_lamp(dvec3(0.3, 0.4, 0.6));
  Light made = sun(0.05f);
  made.intensity = 1.0f;
  put_light(made, dvec3(0.0), dvec3(0.4, -1.0, -0.5), 64);
  put(shapes_[0], at(0.0, -30.0, 30.0));
  settings = test::look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0, 3.0, -2.0), 33, 31);
  const ReadFinalLists empty = expect_sound("sky");
  EXPECT_EQ(empty.counters.tiles, 0u);
  EXPECT_EQ(empty.counters.candidates + empty.counters.slots + empty.counters.fallback_tiles, 0u);
  EXPECT_TRUE(empty.all().empty());
  // A thin sheet and a pole in front of the sky: tiles with near geometry, far geometry and sky.
  put(shapes_[0], glm::scale(at(0.02, 0.5, 1.5), dvec3(0.01, 2.0, 0.01)));
  put(shapes_[3], glm::rotate(at(0.1, 0.9, -1.0), 0.5, dvec3(0.2, 1.0, 0.0)));
  put(shapes_[0], glm::scale(at(0.0, 300.0, -400.0), dvec3(200.0, 100.0, 1.0)));
  settings = test::look_at(dvec3(0.0, 0.5, 2.0), dvec3(0.0, 0.9, -1.0), 33, 31);
  settings.camera.near_m = 0.01f;
  const ReadFinalLists some = expect_sound("pole");
  EXPECT_GT(some.counters.tiles, 3u);
}

// Hard case: shadows.camera_orthographic, shadows.camera_rolled, shadows.near_to_far
TEST_F(DeferredShadowsHard, orthographic_rolled_and_wide_cameras) {
  put_yard();
  put_lamp(dvec3(0.4, 1.4, 0.9));
  put_light(spot(30.0, 0.1f), dvec3(-0.8, 1.6, 0.6), dvec3(0.4, -1.0, -0.4), 64);
  const ViewSettings usual = settings;
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 1.2f;
  EXPECT_GT(expect_sound("orthographic").counters.slots, 0u);
  settings = usual;
  for (const double roll : {0.5, 1.5707963, 3.1}) {
    settings.world_from_camera = usual.world_from_camera * glm::rotate(dmat4(1.0), roll, dvec3(0.0, 0.0, 1.0));
    expect_sound("rolled");
  }
  settings.camera.fov_y = 2.9f;
  expect_sound("wide");
  settings.camera.fov_y = 0.02f;
  expect_sound("narrow");
  settings = usual;
  settings.camera.near_m = 1e-4f;
  settings.camera.far_m = 1e5f;
  expect_sound("near and far");
}

// Hard case: shadows.at_100_km
TEST_F(DeferredShadowsHard, a_scene_100_km_from_the_origin) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const std::string what = "seed " + std::to_string(seed);
    origin = dvec3(0.0);
    world.resource<ShadowTexelGrid>().anchor = origin;
    random_scene(seed + 300);
    const LinearPicture here = frame("deferred").light;
    origin = dvec3(1e5, 37.25, -1e5);
    world.resource<ShadowTexelGrid>().anchor = origin;  // cascades have the same texels there
    random_scene(seed + 300);
    expect_sound(what);
    const LinearPicture there = linear(settings.id.value);
    ASSERT_EQ(here.rgba.size(), there.rgba.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < here.rgba.size(); ++i)
      different += std::abs(here.rgba[i] - there.rgba[i]) <= (here.rgba[i] + 1e-3f) / 255.0f ? 0 : 1;
    EXPECT_LE(different, here.rgba.size() / 1000) << what;
  }
}

// Hard case: shadows.node_zero_scale, shadows.node_mirrored, shadows.node_sheared
TEST_F(DeferredShadowsHard, flat_mirrored_and_sheared_nodes_and_subsurface_things) {
  put_room();
  put_lamp(dvec3(0.4, 1.4, 0.9));
  put_lamp(dvec3(-0.5, 0.6, 0.8));
  dmat4 sheared = at(0.3, 0.5, 0.2);
  sheared[1] = dvec4(0.6, 0.7, 0.0, 0.0);
  for (const std::uint32_t shape : shapes_) {
    put(shape, sheared);
    put(shape, glm::scale(at(-0.5, 0.4, 0.0), dvec3(-0.4, 0.5, 0.4)));
    put(shape, glm::scale(at(0.0, 0.8, 0.4), dvec3(0.5, 0.0, 0.5)));
    put(shape, glm::scale(at(0.9, 0.3, 0.6), dvec3(0.0)));
    expect_sound("shape " + std::to_string(shape));
    clear_scene();
    put_room();
    put_lamp(dvec3(0.4, 1.4, 0.9));
    put_lamp(dvec3(-0.5, 0.6, 0.8));
  }
}

// Hard case: shadows.full_atlas
TEST_F(DeferredShadowsHard, a_full_atlas) {
  put_yard();
  Dice dice(12);
  for (int i = 0; i < 12; ++i) {
    Light made = point(0.1f);
    made.intensity = 0.5f;
    put_light(made, dvec3(-1.3 + 0.22 * i, 1.3, 0.8 - 0.1 * i), dvec3(0.0, -1.0, 0.0), 4096);
  }
  expect_sound("full atlas");
  EXPECT_GT(counter("shadows.faces_shrunk"), 0.0);
}

}  // namespace
}  // namespace gloam
