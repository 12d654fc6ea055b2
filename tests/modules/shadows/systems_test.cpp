// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/systems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>

#include "engine/core/hash.h"
#include "modules/lights/module.h"
#include "modules/shadows/views/faces.h"
#include "tests/jobs/executors.h"
#include "tests/modules/shadows/support/shadow_world.h"

namespace gloam {
namespace {

using test::ShadowWorld;

/// Hash of everything that passes and shaders read.
std::uint64_t hash_of(const ViewFaces& shadows) {
  Hasher hasher;
  const auto floats = [&](std::initializer_list<float> values) {
    for (const float value : values) hasher.bytes_of(value);
  };
  hasher.bytes(std::as_bytes(std::span(shadows.rows)));
  hasher.bytes(std::as_bytes(std::span(shadows.block.directional)));
  hasher.value(shadows.faces_shrunk)
      .value(shadows.faces_left_out)
      .value(shadows.casting_lights)
      .value(shadows.faces.size());
  for (const ShadowFace& face : shadows.faces) {
    hasher.value(face.light.index).value(face.light.generation).value(face.kind).value(face.index);
    hasher.value(face.square.origin.x).value(face.square.origin.y).value(face.square.size);
    hasher.bytes_of(face.origin);
    for (const vec3& v : {face.right, face.up, face.forward}) floats({v.x, v.y, v.z});
    floats({face.tan_half, face.half_extent_m, face.near_m, face.far_m, face.importance});
  }
  return hasher.digest();
}

bool all_finite(std::span<const std::byte> bytes) {
  const auto* values = reinterpret_cast<const float*>(bytes.data());
  return std::all_of(values, values + bytes.size() / sizeof(float), [](float v) { return std::isfinite(v); });
}

/// Expects that rows and faces agree, and that all values are finite.
void expect_sound(const ViewFaces& shadows) {
  EXPECT_TRUE(all_finite(std::as_bytes(std::span(shadows.rows))));
  std::size_t next = 0;
  for (const shaders::ShadowRow& row : shadows.rows) {
    const std::size_t faces = row.kind == GLOAM_SHADOW_CUBE ? 6 : row.kind == GLOAM_SHADOW_SPOT ? 1 : 0;
    for (std::size_t f = 0; f < faces; ++f, ++next) {
      ASSERT_LT(next, shadows.faces.size());
      const ShadowFace& face = shadows.faces[next];
      EXPECT_EQ(face.index, f);
      EXPECT_EQ(vec2(face.square.origin), row.origins[f]);
      EXPECT_EQ(static_cast<float>(face.square.size), row.size);
      EXPECT_EQ(face.tan_half, row.tan_half);
      EXPECT_EQ(face.near_m, row.near_m);
    }
  }
  for (std::size_t d = 0; d < 16; ++d) {
    const shaders::DirectionalShadow& directional = shadows.block.directional[d];
    EXPECT_TRUE(std::isfinite(directional.penumbra_m_per_m));
    for (std::uint32_t c = 0; c < directional.cascade_count; ++c, ++next) {
      ASSERT_LT(next, shadows.faces.size());
      EXPECT_EQ(shadows.faces[next].kind, LightKind::directional);
      EXPECT_TRUE(all_finite(std::as_bytes(std::span(&directional.cascades[c], 1))));
    }
  }
  EXPECT_EQ(next, shadows.faces.size());
  for (const ShadowFace& face : shadows.faces) {
    EXPECT_GE(face.square.size, static_cast<std::uint32_t>(GLOAM_SHADOW_SMALLEST_FACE));
    EXPECT_TRUE(std::isfinite(glm::dot(face.origin, face.origin)) && std::isfinite(face.importance));
    EXPECT_TRUE(std::isfinite(face.far_m) && face.far_m > 0.0f);
  }
}

TEST(ShadowSystems, have_their_names) {
  ShadowWorld scene;
  const std::string text = scene.schedule.describe();
  EXPECT_NE(text.find("shadow_views"), std::string::npos);
  EXPECT_NE(text.find("shadow_bounds"), std::string::npos);
}

TEST(ShadowSystems, find_nothing_in_a_world_without_lights) {
  ShadowWorld scene;
  const ViewFaces& shadows = scene.run();
  EXPECT_TRUE(shadows.faces.empty());
  EXPECT_TRUE(shadows.rows.empty());
  EXPECT_EQ(shadows.casting_lights, 0u);
  EXPECT_EQ(shadows.atlas.used_texels(), 0u);
}

TEST(ShadowSystems, give_a_point_light_six_faces_and_a_spot_one) {
  ShadowWorld scene;
  scene.add_point();
  EXPECT_EQ(scene.run().faces.size(), 6u);
  expect_sound(scene.shadows());
  Light spot;
  spot.kind = LightKind::spot;
  spot.range_m = 5.0f;
  scene.add(spot);
  EXPECT_EQ(scene.run().faces.size(), 7u);
  EXPECT_EQ(scene.shadows().casting_lights, 2u);
  EXPECT_EQ(scene.shadows().faces_shrunk, 0u);
  expect_sound(scene.shadows());
}

TEST(ShadowSystems, take_lights_without_a_caster_component_as_casting_and_disabled_ones_as_not) {
  ShadowWorld scene;
  const Entity light = scene.add_point();
  scene.world.add(light, ShadowCaster{});
  EXPECT_EQ(scene.run().faces.size(), 6u);
  scene.world.get<ShadowCaster>(light).enabled = false;
  EXPECT_TRUE(scene.run().faces.empty());
  EXPECT_EQ(scene.shadows().casting_lights, 0u);
  ASSERT_EQ(scene.shadows().rows.size(), 1u);
  EXPECT_EQ(scene.shadows().rows[0].kind, static_cast<float>(GLOAM_SHADOW_NONE));
}

TEST(ShadowSystems, let_the_caster_component_say_the_resolution) {
  ShadowWorld scene;
  const Entity light = scene.add_point();
  scene.world.add(light, ShadowCaster{.resolution = 100});
  const Entity sun = scene.add_sun();
  scene.world.add(sun, ShadowCaster{.resolution = 512});
  scene.add_mesh({0, 0, -8});
  for (const ShadowFace& face : scene.run().faces)
    EXPECT_EQ(face.square.size, face.kind == LightKind::directional ? 512u : 128u);
  EXPECT_GT(scene.shadows().block.directional[0].cascade_count, 0u);
}

TEST(ShadowSystems, give_nearer_lights_more_texels) {
  ShadowWorld scene;
  const Entity light = scene.add_point();
  std::uint32_t last = 4096;
  for (const double distance : {3.0, 20.0, 60.0, 300.0}) {
    scene.world.get<WorldTransform>(light).matrix[3].z = -distance;
    const std::uint32_t size = scene.run().faces.at(0).square.size;
    EXPECT_LT(size, last) << distance;
    last = size;
  }
  EXPECT_EQ(last, 16u);
}

TEST(ShadowSystems, change_nothing_when_the_camera_turns_in_place) {
  ShadowWorld scene;
  scene.add_point();
  const std::vector<ShadowFace> first = scene.run().faces;
  scene.settings.world_from_camera = glm::rotate(dmat4(1.0), 0.2, dvec3(0.1, 1.0, 0.3));
  const std::vector<ShadowFace>& second = scene.run().faces;
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(second[i].square, first[i].square);
}

TEST(ShadowSystems, keep_squares_of_lights_that_stay_when_others_come_and_go) {
  ShadowWorld scene;
  scene.shadow_settings().texels_per_pixel = 1.0f;  // the atlas has room for all
  scene.add_random(30);
  const Entity light = scene.add_point();
  const auto square = [&] {
    for (const ShadowFace& face : scene.shadows().faces)
      if (face.light == light) return face.square;
    return AtlasSquare{};
  };
  scene.run();
  const AtlasSquare first = square();
  ASSERT_GT(first.size, 0u);
  const Entity other = scene.add_point();
  scene.run();
  EXPECT_EQ(square(), first);
  scene.world.destroy(other);
  scene.run();
  EXPECT_EQ(square(), first);
}

TEST(ShadowSystems, have_none_when_switched_off_and_all_again_when_on) {
  ShadowWorld scene;
  scene.add_point();
  scene.add_sun();
  const std::uint64_t before = hash_of(scene.run());
  scene.shadow_settings().enabled = false;
  EXPECT_TRUE(scene.run().faces.empty());
  EXPECT_EQ(scene.shadows().casting_lights, 0u);
  EXPECT_EQ(scene.shadows().rows.size(), 1u);
  EXPECT_EQ(scene.shadows().block.directional[0].cascade_count, 0u);
  scene.shadow_settings().enabled = true;
  EXPECT_EQ(hash_of(scene.run()), before);
}

TEST(ShadowSystems, follow_the_settings) {
  ShadowWorld scene;
  scene.add_point();
  scene.add_sun();
  scene.run();
  EXPECT_EQ(scene.shadows().block.directional[0].cascade_count, 4u);
  scene.shadow_settings().cascades = 2;
  scene.shadow_settings().kernel_rim = 0.5f;
  scene.shadow_settings().atlas_size = 1024;
  const ViewFaces& shadows = scene.run();
  EXPECT_EQ(shadows.block.directional[0].cascade_count, 2u);
  EXPECT_EQ(shadows.atlas.size(), 1024u);
  EXPECT_EQ(shadows.rows[0].tan_half, 1.5f);
  expect_sound(shadows);
  scene.shadow_settings().cascades = 100;
  EXPECT_EQ(scene.run().block.directional[0].cascade_count, static_cast<std::uint32_t>(GLOAM_MAX_CASCADES));
}

TEST(ShadowSystems, give_lights_as_many_texels_as_the_atlas_has_room_for) {
  for (const std::uint32_t count : {3u, 30u, 300u}) {
    ShadowWorld scene;
    scene.add_random(count);
    scene.add_sun();
    scene.add_mesh({0, 0, -30});
    scene.shadow_settings().texels_per_pixel = 4.0f;
    const ViewFaces& shadows = scene.run();
    EXPECT_EQ(shadows.faces_shrunk, 0u) << count;
    EXPECT_GT(shadows.texels_per_pixel, 0.0f);
    EXPECT_LE(shadows.texels_per_pixel, 4.0f);
    const bool most = shadows.texels_per_pixel == 4.0f;
    EXPECT_TRUE(most || shadows.atlas.used_texels() > 4096u * 4096u / 8) << count;
    expect_sound(shadows);
  }
}

TEST(ShadowSystems, count_the_faces_that_have_fewer_texels_than_asked_for) {
  ShadowWorld scene;
  const Entity light = scene.add_point();
  scene.world.get<WorldTransform>(light).matrix[3].z = -300.0;
  EXPECT_EQ(scene.run().faces_at_limit, 0u) << "small in the picture";
  scene.world.get<WorldTransform>(light).matrix[3].z = -1.0;
  EXPECT_EQ(scene.run().faces_at_limit, 6u) << "the camera is among the surfaces that it lights";
  scene.world.add(light, ShadowCaster{.resolution = 64});
  EXPECT_EQ(scene.run().faces_at_limit, 0u) << "the scene says how many texels it wants";
  ShadowWorld full;
  full.add_random(60);
  full.shadow_settings().texels_per_pixel = 8.0f;
  const ViewFaces& shadows = full.run();
  EXPECT_EQ(shadows.faces_at_limit, shadows.faces.size()) << "the density was lowered";
}

TEST(ShadowSystems, take_an_atlas_as_large_as_the_faces_need) {
  ShadowWorld scene;
  const Entity light = scene.add_point();
  scene.world.add(light, ShadowCaster{.resolution = 128});
  EXPECT_EQ(scene.run().atlas.size(), 512u) << "six faces of 128²";
  scene.world.get<ShadowCaster>(light).resolution = 1024;
  EXPECT_EQ(scene.run().atlas.size(), 4096u);
  scene.world.get<ShadowCaster>(light).resolution = 128;
  for (std::uint32_t frame = 0; frame < AtlasSide::kFramesKept; ++frame) ASSERT_EQ(scene.run().atlas.size(), 4096u);
  EXPECT_EQ(scene.run().atlas.size(), 512u);
  expect_sound(scene.shadows());
}

TEST(ShadowSystems, change_no_map_when_lights_leave_the_view_of_a_full_atlas) {
  ShadowWorld scene;
  scene.add_random(60);
  scene.shadow_settings().texels_per_pixel = 8.0f;
  const ViewFaces& shadows = scene.run();
  EXPECT_LT(shadows.texels_per_pixel, 8.0f) << "the atlas is full";
  const std::vector<ShadowFace> first = shadows.faces;
  scene.settings.world_from_camera = glm::rotate(dmat4(1.0), 0.4, dvec3(0.0, 1.0, 0.0));
  EXPECT_LT(scene.run().faces.size(), first.size()) << "some are out of view";
  for (const ShadowFace& face : shadows.faces)
    for (const ShadowFace& before : first)
      EXPECT_TRUE(before.light != face.light || before.index != face.index || before.square == face.square);
}

TEST(ShadowSystems, choose_sizes_anew_when_what_they_go_by_changes) {
  ShadowWorld scene;
  scene.add_random(60);
  scene.shadow_settings().texels_per_pixel = 8.0f;
  const auto sizes = [](const ViewFaces& shadows) {
    std::vector<std::uint32_t> texels;
    for (const ShadowFace& face : shadows.faces) texels.push_back(face.square.size);
    return texels;
  };
  const ViewFaces& shadows = scene.run();
  const float density = shadows.texels_per_pixel;
  const std::vector<std::uint32_t> first = sizes(shadows);
  scene.shadow_settings().atlas_size = 1024;
  EXPECT_LT(scene.run().texels_per_pixel, density);
  scene.shadow_settings().atlas_size = 4096;
  EXPECT_EQ(scene.run().texels_per_pixel, density);
  EXPECT_EQ(sizes(shadows), first);
  scene.shadow_settings().texels_per_pixel = 0.5f;
  EXPECT_NE(sizes(scene.run()), first);
  scene.shadow_settings().texels_per_pixel = 8.0f;
  EXPECT_EQ(sizes(scene.run()), first);
  // The camera comes near a light and goes back, in a cut: what lies between says nothing.
  scene.settings.world_from_camera = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -40.0));
  EXPECT_NE(sizes(scene.run()), first);
  scene.settings.world_from_camera = dmat4(1.0);
  scene.settings.camera_cut = true;
  EXPECT_EQ(sizes(scene.run()), first);
}

// Hard case: shadows.full_atlas
TEST(ShadowSystems, shrink_faces_of_a_full_atlas_and_say_so) {
  ShadowWorld scene;
  scene.add_random(400);
  std::vector<Entity> lights;
  scene.world.view<const Light>().each([&](Entity light, const Light&) { lights.push_back(light); });
  for (const Entity light : lights) scene.world.add(light, ShadowCaster{.resolution = 64});
  scene.shadow_settings().atlas_size = 1024;
  const ViewFaces& shadows = scene.run();
  EXPECT_GT(shadows.faces_shrunk, 0u);
  EXPECT_LE(shadows.atlas.used_texels(), 1024u * 1024u);
  expect_sound(shadows);
}

TEST(ShadowSystems, leave_lights_out_when_not_even_the_smallest_faces_fit) {
  ShadowWorld scene;
  scene.add_random(100);
  scene.shadow_settings().atlas_size = 64;
  const ViewFaces& shadows = scene.run();
  EXPECT_GT(shadows.faces_left_out, 0u);
  EXPECT_LE(shadows.faces.size(), 16u);
  EXPECT_FALSE(shadows.faces.empty());
  EXPECT_EQ(shadows.casting_lights, shadows.rows.size());
  expect_sound(shadows);
}

TEST(ShadowSystems, serve_a_thousand_and_twenty_four_point_lights) {
  ShadowWorld scene;
  scene.add_random(2000);
  scene.world.view<Light>().each([](Light& light) { light.kind = LightKind::point; });
  const ViewFaces& shadows = scene.run();
  EXPECT_EQ(shadows.rows.size(), 1024u);
  EXPECT_EQ(shadows.faces.size() + shadows.faces_left_out, 6144u);
  EXPECT_EQ(shadows.faces_left_out, 0u);
  expect_sound(shadows);
}

TEST(ShadowSystems, keep_numbers_that_are_none_out_of_faces) {
  ShadowWorld scene;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
    for (const float bad : {nan, infinity, -infinity, 0.0f, -1.0f}) {
      Light light;
      light.kind = kind;
      light.range_m = bad;
      scene.add(light);
      light.intensity = bad;
      scene.add(light);
      light = {};
      light.kind = kind;
      light.width_m = light.inner_angle = bad;
      scene.add(light);
      light = {};
      light.kind = kind;
      light.outer_angle = light.apparent_angle = bad;
      scene.add(light);
      light = {};
      light.kind = kind;
      scene.add(light, dmat4(static_cast<double>(bad)));
      scene.add(light, glm::translate(dmat4(1.0), dvec3(bad)));
      scene.add(light, glm::scale(glm::translate(dmat4(1.0), dvec3(0, 0, -3)), dvec3(bad)));
    }
  }
  scene.add_mesh({0, 0, -5});
  scene.add_mesh(dvec3(std::numeric_limits<double>::quiet_NaN()));
  scene.add_mesh(dvec3(std::numeric_limits<double>::infinity()));
  for (int frame = 0; frame < 2; ++frame) {
    const ViewFaces& shadows = scene.run();
    EXPECT_FALSE(shadows.faces.empty());
    expect_sound(shadows);
  }
}

TEST(ShadowSystems, serve_lights_around_and_behind_every_kind_of_camera) {
  ShadowWorld scene;
  Light light;
  light.range_m = 6.0f;
  scene.add(light, dmat4(1.0));                                   // the camera is inside the light's range
  scene.add(light, glm::translate(dmat4(1.0), dvec3(0, 0, 4)));   // behind the camera; its range reaches in front of it
  scene.add(light, glm::translate(dmat4(1.0), dvec3(0, 0, 40)));  // entirely behind the camera
  for (const bool orthographic : {false, true}) {
    scene.settings.camera.orthographic = orthographic;
    scene.settings.camera.half_height_m = 3.0f;
    const ViewFaces& shadows = scene.run();
    EXPECT_EQ(shadows.rows.size(), 2u);
    EXPECT_EQ(shadows.faces.size(), 12u);
    expect_sound(shadows);
  }
}

TEST(ShadowSystems, put_the_casters_between_a_suns_near_and_far_side) {
  ShadowWorld scene;
  scene.add_sun();
  scene.add_mesh({0, 0, -10});
  scene.add_mesh({3, 20, -30});
  const ViewFaces& shadows = scene.run();
  ASSERT_FALSE(shadows.faces.empty());
  expect_sound(shadows);
  for (const ShadowFace& face : shadows.faces) {
    for (const dvec3& at : {dvec3(-1, -1, -9), dvec3(4, 21, -31)}) {
      const auto seen = project(face, at);
      EXPECT_GE(seen->depth, 0.0);
      EXPECT_LE(seen->depth, 1.0);
    }
  }
  EXPECT_NEAR(shadows.block.directional[0].penumbra_m_per_m, 0.00925025f, 1e-6f);
}

TEST(ShadowSystems, find_skinned_meshes_where_their_joints_are) {
  ShadowWorld scene;
  scene.add_sun();
  scene.add_mesh({0, 0, -10});
  const Entity skinned = scene.world.create(MeshInstance{0, 0}, WorldTransform{});
  auto& joints = scene.world.resource<JointMatrices>();
  joints.ranges.push_back({skinned, 0, 1, dvec3(100.0, 0.0, 0.0), false});
  joints.matrices.push_back(mat4(1.0f));
  // Calls the system directly, because the world's systems would overwrite the joint matrices.
  scene.run();
  World& world = scene.world;
  const ViewId id = scene.settings.id;
  shadow_bounds_system(ViewResource<const VisibleLights>(std::as_const(world).view_resource<VisibleLights>(id)),
                       View<const MeshInstance, const WorldTransform>(std::as_const(world)),
                       View<const CasterVolume>(std::as_const(world)),
                       Resource<const SceneAssets>(std::as_const(world).resource<SceneAssets>()),
                       Resource<const JointMatrices>(joints),
                       Resource<const ShadowTexelGrid>(std::as_const(world).resource<ShadowTexelGrid>()),
                       ViewResource<CasterBounds>(world.view_resource<CasterBounds>(id)), *make_serial_executor());
  const CasterBounds& bounds = world.view_resource<CasterBounds>(id);
  EXPECT_EQ(bounds.min, dvec3(-1, -1, -11));
  EXPECT_EQ(bounds.max, dvec3(101, 1, 1));
}

TEST(ShadowSystems, cascades_hold_volumes_of_casters_without_a_mesh) {
  ShadowWorld scene;
  scene.add_sun();
  scene.add_mesh({0, 0, -10});
  scene.run();
  const CasterBounds& bounds = scene.world.view_resource<CasterBounds>(scene.settings.id);
  EXPECT_EQ(bounds.max, dvec3(1, 1, -9));
  const Entity volume = scene.world.create(CasterVolume{dvec3(-3, 0, -12), dvec3(0, 7, -10)});
  scene.world.create(CasterVolume{dvec3(0, 100, 0), dvec3(0, 99, 0)});
  scene.world.create(CasterVolume{dvec3(0.0), dvec3(std::numeric_limits<double>::infinity())});
  scene.run();
  EXPECT_EQ(bounds.min, dvec3(-3, -1, -12));
  EXPECT_EQ(bounds.max, dvec3(1, 7, -9));
  scene.world.destroy(volume);
  scene.run();
  EXPECT_EQ(bounds.max, dvec3(1, 1, -9));
}

TEST(ShadowSystems, survive_lights_that_lose_their_components_between_the_stages) {
  ShadowWorld scene;
  scene.add_point();
  const Entity gone = scene.add_point();
  const Entity dark = scene.add_point();
  const auto executor = make_serial_executor();
  scene.run(*executor);
  scene.schedule.run(Stage::world, scene.world, *executor);
  scene.world.destroy(gone);
  scene.world.remove<Light>(dark);
  scene.schedule.run_view(scene.settings.id, scene.world, *executor);
  EXPECT_EQ(scene.shadows().rows.size(), 3u);
  EXPECT_EQ(scene.shadows().faces.size(), 6u);
}

TEST(ShadowSystems, make_the_same_faces_with_every_executor) {
  std::vector<std::uint64_t> hashes;
  for (const test::ExecutorCase& c : test::all_executors()) {
    ShadowWorld scene;
    scene.add_random(1500);
    scene.add_sun();
    for (int i = 0; i < 3000; ++i) scene.add_mesh({i % 50, 0, -i / 50});
    scene.shadow_settings().atlas_size = 2048;
    const auto executor = c.make();
    std::uint64_t hash = 0;
    for (int frame = 0; frame < 4; ++frame) {
      scene.settings.world_from_camera[3].z -= 2.0;
      scene.run(*executor);
      hash = hash * 31 + hash_of(scene.shadows());
    }
    expect_sound(scene.shadows());
    hashes.push_back(hash);
    EXPECT_EQ(hashes.back(), hashes.front()) << c.name;
  }
}

}  // namespace
}  // namespace gloam
