// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <optional>
#include <utility>

#include "engine/scene/gltf/import.h"
#include "engine/scene/units.h"
#include "modules/reflections/planar/mirror.h"
#include "modules/reflections/scene_unit.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

struct MirrorPlanes : testing::Test {
  MirrorPlanes() { prepare_scene_world(world); }

  [[nodiscard]] static dmat4 flat_at(const dvec3& place) {
    return glm::rotate(glm::translate(dmat4(1.0), place), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
  }
  std::uint32_t material(float reflectivity, float roughness = 0.0f) {
    Material made;
    made.reflectivity = reflectivity;
    made.roughness = roughness;
    return maker.material(std::move(made));
  }
  Entity floor(double half, const dvec3& place, std::uint32_t made_of) {
    return maker.draw(maker.mesh(test::quad(static_cast<float>(half), made_of)), flat_at(place));
  }
  [[nodiscard]] std::optional<PlanarMirror> chosen(const dvec3& eye = {0.0, 3.0, 8.0},
                                                   const dvec3& target = dvec3(0.0)) {
    patches.update(world);
    ViewSettings view = test::look_at(eye, target, 64, 48);
    view.camera.near_m *= static_cast<float>(scene_unit(world));
    return choose_mirror(patches.all(), make_view(view, 0), scene_unit(world));
  }

  World world;
  test::SceneMaker maker{world};
  MirrorPatches patches;
};

TEST_F(MirrorPlanes, the_largest_horizontal_mirror_in_view_is_chosen) {
  const std::uint32_t mirror = material(1.0f);
  floor(1.0, {0.0, 0.5, 0.0}, mirror);
  floor(3.0, {0.0, 0.1, -2.0}, mirror);
  floor(9.0, {0.0, 0.3, 0.0}, material(0.0f));
  floor(9.0, {0.0, 0.2, 0.0}, material(1.0f, 0.6f));
  ASSERT_TRUE(chosen());
  EXPECT_NEAR(chosen()->height_m, 0.1, 1e-6);
}

TEST_F(MirrorPlanes, the_back_of_a_mirror_with_two_sides_is_one_too) {
  const dmat4 down =
      glm::rotate(glm::translate(dmat4(1.0), dvec3(0.0, 0.5, 0.0)), 1.57079632679489661923, dvec3(1, 0, 0));
  const std::uint32_t single = material(1.0f), both = material(1.0f);
  maker.assets().materials[both].double_sided = true;
  maker.draw(maker.mesh(test::quad(3.0f, single)), down);
  EXPECT_FALSE(chosen());
  maker.draw(maker.mesh(test::quad(3.0f, both)), down);
  ASSERT_TRUE(chosen());
  EXPECT_NEAR(chosen()->height_m, 0.5, 1e-6);
  EXPECT_FALSE(chosen({0.0, -3.0, 8.0})) << "from below";
}

TEST_F(MirrorPlanes, surfaces_within_two_centimetres_are_one_plane) {
  const std::uint32_t mirror = material(1.0f);
  floor(2.0, {0.0, 1.0, 0.0}, mirror);
  for (int i = 0; i < 3; ++i) floor(1.5, {2.0 * i - 2.0, 0.1 + 0.009 * i, 0.0}, mirror);
  const auto mirror_plane = chosen();
  ASSERT_TRUE(mirror_plane);
  EXPECT_NEAR(mirror_plane->height_m, 0.109, 1e-6);
  for (const double height : {0.1, 0.109, 0.118})
    EXPECT_LE(std::abs(height - mirror_plane->height_m), mirror_plane->slack_m);
  EXPECT_LT(mirror_plane->slack_m, kPlaneThickness);
}

TEST_F(MirrorPlanes, the_same_scene_in_other_units_has_the_same_plane) {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    world.set_resource(SceneUnits{1.0 / unit});
    const std::uint32_t mirror = material(1.0f);
    std::vector<Entity> made;
    made.push_back(floor(0.2 * unit, dvec3(0.0, 1.0, 0.0) * unit, mirror));
    for (int i = 0; i < 3; ++i)
      made.push_back(floor(1.5 * unit, dvec3(2.0 * i - 2.0, 0.1 + 0.009 * i, 0.0) * unit, mirror));
    made.push_back(floor(1.5 * unit, dvec3(0.0, 0.14, 0.0) * unit, mirror));
    const auto plane = chosen(dvec3(0.0, 3.0, 8.0) * unit);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->height_m, 0.109 * unit, 1e-6 * unit);
    EXPECT_NEAR(plane->slack_m, (0.009 + 0.005) * unit, 1e-5 * unit);
    EXPECT_NEAR(mirrored_settings({}, *plane, 2, unit).mirror->margin_m, (0.009 + 0.001) * unit, 1e-5 * unit);
    for (const Entity entity : made) world.destroy(entity);
  }
}

TEST_F(MirrorPlanes, walls_ceilings_and_slopes_are_none) {
  const std::uint32_t mesh = maker.mesh(test::quad(3.0f, material(1.0f)));
  maker.draw(mesh, dmat4(1.0));
  maker.draw(mesh, glm::rotate(dmat4(1.0), 1.57079632679, dvec3(1.0, 0.0, 0.0)));
  maker.draw(mesh, glm::rotate(dmat4(1.0), -1.3, dvec3(1.0, 0.0, 0.0)));
  EXPECT_FALSE(chosen());
  // Mirrored, the ceiling's triangles face up.
  maker.draw(mesh, glm::scale(flat_at(dvec3(0.0)), dvec3(1.0, -1.0, 1.0)));
  EXPECT_TRUE(chosen());
}

TEST_F(MirrorPlanes, a_camera_below_the_plane_or_looking_away_has_none) {
  floor(3.0, {0.0, 1.0, 0.0}, material(1.0f));
  EXPECT_TRUE(chosen());
  EXPECT_FALSE(chosen({0.0, 0.5, 8.0}, {0.0, 0.9, 0.0}));
  EXPECT_FALSE(chosen({0.0, 1.0, 8.0}));
  EXPECT_FALSE(chosen({0.0, 3.0, 8.0}, {0.0, 3.0, 20.0}));
  EXPECT_FALSE(chosen({0.0, 3.0, 0.0}, {0.0, 30.0, 1.0}));
}

TEST_F(MirrorPlanes, an_orthographic_camera_that_looks_up_has_none) {
  floor(3.0, {0.0, 1.0, 0.0}, material(1.0f));
  patches.update(world);
  ViewSettings settings = test::look_at({0.0, 0.0, 8.0}, {0.0, 2.0, 0.0}, 64, 48);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 4.0f;
  EXPECT_FALSE(choose_mirror(patches.all(), make_view(settings, 0), 1.0));
  settings = test::look_at({0.0, 4.0, 8.0}, {0.0, 1.0, 0.0}, 64, 48);
  settings.camera.orthographic = true;
  settings.camera.half_height_m = 4.0f;
  EXPECT_TRUE(choose_mirror(patches.all(), make_view(settings, 0), 1.0));
}

TEST_F(MirrorPlanes, only_instances_that_change_are_searched_again) {
  const std::uint32_t mirror = material(1.0f);
  const Entity moving = floor(3.0, {0.0, 0.1, 0.0}, mirror);
  floor(1.0, {0.0, 0.5, 0.0}, mirror);
  patches.update(world);
  patches.update(world);
  EXPECT_EQ(patches.searched(), 2u);
  world.get<WorldTransform>(moving).matrix = flat_at({0.0, 0.2, 0.0});
  EXPECT_NEAR(chosen()->height_m, 0.2, 1e-6);
  EXPECT_EQ(patches.searched(), 3u);
  maker.assets().materials[0].reflectivity = 0.0f;
  ++maker.assets().version;
  EXPECT_FALSE(chosen());
  maker.assets().materials[0].reflectivity = 1.0f;
  ++maker.assets().version;
  world.destroy(moving);
  EXPECT_NEAR(chosen()->height_m, 0.5, 1e-6);
}

TEST_F(MirrorPlanes, the_mirrored_view_sees_the_same_part_of_the_world_for_odd_sizes) {
  ViewSettings main = test::look_at({0.0, 3.0, 8.0}, dvec3(0.0), 7, 5);
  const ViewSettings half = mirrored_settings(main, {.height_m = 0.5, .slack_m = 0.01}, 2, 1.0);
  EXPECT_EQ(half.width, 4u);
  EXPECT_EQ(half.height, 3u);
  const RenderView view = make_view(main, 0), mirrored = make_view(half, 0);
  EXPECT_EQ(view.clip_from_view, mirrored.clip_from_view);
  // Points of the plane are at the same place in both pictures.
  for (const dvec3& point : {dvec3(0.0, 0.5, 0.0), dvec3(1.0, 0.5, -3.0), dvec3(-2.0, 0.5, 2.0)}) {
    const vec4 a = view.clip_from_relative * vec4(view.relative(point), 1.0f);
    const vec4 b = mirrored.clip_from_relative * vec4(mirrored.relative(point), 1.0f);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-5);
  }
}

}  // namespace
}  // namespace gloam
